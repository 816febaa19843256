"use strict";
// gears and shafts in space from glTF 2.0: parts that turn about z; m, y upwards, z along the shafts
const space = (function () {
  const WIDE = 0.5, LIGHT = [0.36, 0.62, 0.7], STEP = 0.12, NEAREST = 0.02, FARTHEST = 8;
  const VIEWS = { oblique: [-0.6, 0.35], "along the shafts": [0, 0], "from the side": [-Math.PI / 2, 0], "from above": [0, Math.PI / 2] };
  const VERTEX = `#version 300 es
    in vec3 point; in vec3 normal; in vec2 tooth;
    uniform vec2 turn; uniform vec3 centre; uniform mat4 seen;
    out vec3 facing; out vec3 place;
    vec2 by(vec2 one, vec2 two) { return vec2(one.x * two.x - one.y * two.y, one.x * two.y + one.y * two.x); }
    void main() {
      vec2 turned = by(turn, tooth);
      place = vec3(by(turned, point.xy), point.z) + centre;
      facing = vec3(by(turned, normal.xy), normal.z);
      gl_Position = seen * vec4(place, 1.0);
    }`;
  const FRAGMENT = `#version 300 es
    precision highp float;
    in vec3 facing; in vec3 place; uniform vec3 color; uniform vec3 eye; uniform vec3 light; out vec4 shown;
    void main() {
      vec3 n = normalize(facing), to = normalize(eye - place);
      float glance = pow(max(dot(n, normalize(light + to)), 0.0), 30.0);
      shown = vec4(color * (0.38 + 0.45 * max(dot(n, light), 0.0) + 0.25 * max(dot(n, to), 0.0)) + 0.16 * glance, 1.0);
    }`;
  const cross = (a, b) => [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]];
  const dot = (a, b) => a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
  const unit = (a) => a.map((one) => one / Math.hypot(...a));
  const angleOf = (node) => 2 * Math.atan2((node.rotation || [0, 0, 0, 1])[2], (node.rotation || [0, 0, 0, 1])[3]);
  // sRGB of a linear colour
  const shade = (one) => one <= 0.0031308 ? 12.92 * one : 1.055 * Math.pow(one, 1 / 2.4) - 0.055;

  // parts of a binary file: a node of the scene each, drawn as the mesh of its own or those of its children
  function read(bytes) {
    const view = new DataView(bytes), length = view.getUint32(12, true);
    if (view.getUint32(0, true) !== 0x46546c67 || view.getUint32(4, true) !== 2) throw new Error("no glTF 2.0");
    const whole = JSON.parse(new TextDecoder().decode(new Uint8Array(bytes, 20, length))), start = 28 + length;
    const values = (number) => {
      const accessor = whole.accessors[number], Kind = { 5126: Float32Array, 5125: Uint32Array }[accessor.componentType];
      return new Kind(bytes, start + whole.bufferViews[accessor.bufferView].byteOffset, accessor.count * { SCALAR: 1, VEC3: 3 }[accessor.type]);
    };
    const meshes = whole.meshes.map((mesh) => {
      const own = mesh.primitives[0], color = whole.materials[own.material].pbrMetallicRoughness.baseColorFactor;
      const point = values(own.attributes.POSITION), normal = values(own.attributes.NORMAL);
      let radius = 0, low = Infinity, high = -Infinity;
      for (let k = 0; k < point.length; k += 3) {
        radius = Math.max(radius, Math.hypot(point[k], point[k + 1]));
        low = Math.min(low, point[k + 2]);
        high = Math.max(high, point[k + 2]);
      }
      return { point: point, normal: normal, index: values(own.indices), color: color.slice(0, 3).map(shade), radius: radius, low: low, high: high };
    });
    return whole.scenes[whole.scene].nodes.map((number) => {
      const node = whole.nodes[number], children = (node.children || []).map((child) => whole.nodes[child]);
      const own = children.length ? children : [{ mesh: node.mesh }];
      return Object.assign({ turns: 0, orbits: 0, axis: [0, 0] }, node.extras, {
        name: node.name, centre: node.translation, angle: angleOf(node), mesh: meshes[own[0].mesh], visible: true,
        tooth: Float32Array.from(own.flatMap((child) => [Math.cos(angleOf(child)), Math.sin(angleOf(child))])),
      });
    });
  }
  // where a part stands after so many radians of the first one
  function placed(part, turned) {
    const angle = part.orbits * turned, c = Math.cos(angle), s = Math.sin(angle), own = part.angle + part.turns * turned;
    const x = part.centre[0] - part.axis[0], y = part.centre[1] - part.axis[1];
    return { centre: [part.axis[0] + c * x - s * y, part.axis[1] + s * x + c * y, part.centre[2]], turn: [Math.cos(own), Math.sin(own)] };
  }
  // circles about a part, by which it is seen whole
  function around(part, turned) {
    const { centre } = placed(part, turned), found = [];
    for (const z of [part.mesh.low, part.mesh.high]) for (let k = 0; k < 12; k++)
      found.push([centre[0] + part.mesh.radius * Math.cos(k * Math.PI / 6), centre[1] + part.mesh.radius * Math.sin(k * Math.PI / 6), centre[2] + z]);
    return found;
  }
  // axes of sight: right, up, towards the eye
  function axes(view) {
    const cy = Math.cos(view.yaw), sy = Math.sin(view.yaw), cp = Math.cos(view.pitch), sp = Math.sin(view.pitch);
    return [[cy, 0, sy], [sy * sp, cp, -cy * sp], [-sy * cp, sp, cy * cp]];
  }
  function camera(view, aspect) {
    const [right, up, back] = axes(view), eye = view.target.map((one, k) => one + view.distance * back[k]);
    const reach = 3 * view.size, near = Math.max(0.01 * view.distance, view.distance - reach), far = view.distance + reach;
    const rows = [right.map((one) => one / (WIDE * aspect)), up.map((one) => one / WIDE), back.map((one) => one * (near + far) / (near - far)), back.map((one) => -one)];
    const moved = rows.map((row) => -dot(row, eye));
    moved[2] += 2 * near * far / (near - far);
    return { eye: eye, right: right, up: up, back: back, matrix: Float32Array.from([0, 1, 2].flatMap((k) => rows.map((row) => row[k])).concat(moved)) };
  }
  function fitted(parts, view, aspect, turned) {
    const shown = parts.some((part) => part.visible) ? parts.filter((part) => part.visible) : parts;
    const places = shown.flatMap((part) => around(part, turned)), [right, up, back] = axes(view);
    const ends = [right, up, back].map((axis) => places.map((place) => dot(axis, place)));
    const middle = ends.map((along) => (Math.min(...along) + Math.max(...along)) / 2);
    view.target = [0, 1, 2].map((k) => right[k] * middle[0] + up[k] * middle[1] + back[k] * middle[2]);
    view.size = Math.max(...ends.map((along) => Math.max(...along) - Math.min(...along)));
    view.distance = 1.06 * Math.max(...places.map((_, k) => ends[2][k] - middle[2] + Math.max(Math.abs(ends[0][k] - middle[0]) / aspect, Math.abs(ends[1][k] - middle[1])) / WIDE));
    view.fitted = view.distance;
  }

  // a picture by WebGL: draws parts; null where there is none
  function byWebGl(canvas) {
    canvas.dataset.drawn = "by a painter";
    const gl = canvas.getContext("webgl2", { antialias: true, alpha: true, preserveDrawingBuffer: true });
    if (!gl) return null;
    const program = gl.createProgram();
    for (const [kind, text] of [[gl.VERTEX_SHADER, VERTEX], [gl.FRAGMENT_SHADER, FRAGMENT]]) {
      const made = gl.createShader(kind);
      gl.shaderSource(made, text);
      gl.compileShader(made);
      gl.attachShader(program, made);
    }
    gl.linkProgram(program);
    if (!gl.getProgramParameter(program, gl.LINK_STATUS)) return null;
    canvas.dataset.drawn = "by WebGL";
    const at = (name) => gl.getUniformLocation(program, name), places = {}, kept = new Map();
    for (const name of ["turn", "centre", "seen", "color", "eye", "light"]) places[name] = at(name);
    function buffers(part) {
      const whole = gl.createVertexArray();
      gl.bindVertexArray(whole);
      for (const [name, values, size, each] of [["point", part.mesh.point, 3, 0], ["normal", part.mesh.normal, 3, 0], ["tooth", part.tooth, 2, 1]]) {
        const place = gl.getAttribLocation(program, name);
        gl.bindBuffer(gl.ARRAY_BUFFER, gl.createBuffer());
        gl.bufferData(gl.ARRAY_BUFFER, values, gl.STATIC_DRAW);
        gl.enableVertexAttribArray(place);
        gl.vertexAttribPointer(place, size, gl.FLOAT, false, 0, 0);
        gl.vertexAttribDivisor(place, each);
      }
      gl.bindBuffer(gl.ELEMENT_ARRAY_BUFFER, gl.createBuffer());
      gl.bufferData(gl.ELEMENT_ARRAY_BUFFER, part.mesh.index, gl.STATIC_DRAW);
      return whole;
    }
    return (parts, view, turned, colors) => {
      const seen = camera(view, canvas.width / canvas.height);
      gl.viewport(0, 0, canvas.width, canvas.height);
      gl.clearColor(0, 0, 0, 0);
      gl.clear(gl.COLOR_BUFFER_BIT | gl.DEPTH_BUFFER_BIT);
      gl.enable(gl.DEPTH_TEST);
      gl.enable(gl.CULL_FACE);
      gl.useProgram(program);
      gl.uniformMatrix4fv(places.seen, false, seen.matrix);
      gl.uniform3fv(places.eye, seen.eye);
      gl.uniform3fv(places.light, lit(seen));
      for (const part of parts) {
        if (!part.visible) continue;
        if (!kept.has(part)) kept.set(part, buffers(part));
        const { centre, turn } = placed(part, turned);
        gl.bindVertexArray(kept.get(part));
        gl.uniform2fv(places.turn, turn);
        gl.uniform3fv(places.centre, centre);
        gl.uniform3fv(places.color, colors(part));
        gl.drawElementsInstanced(gl.TRIANGLES, part.mesh.index.length, gl.UNSIGNED_INT, 0, part.tooth.length / 2);
      }
    };
  }
  const lit = (seen) => unit([0, 1, 2].map((k) => LIGHT[0] * seen.right[k] + LIGHT[1] * seen.up[k] + LIGHT[2] * seen.back[k]));
  // the same on paper: triangles that look at the eye, the farthest first
  function byPainter(canvas) {
    const context = canvas.getContext("2d");
    return context && ((parts, view, turned, colors) => {
      const seen = camera(view, canvas.width / canvas.height), light = lit(seen), faces = [], flat = project(seen, canvas.width, canvas.height);
      context.clearRect(0, 0, canvas.width, canvas.height);
      for (const part of parts) {
        if (!part.visible) continue;
        const { centre, turn } = placed(part, turned), { point, index } = part.mesh, rgb = colors(part);
        for (let t = 0; t < part.tooth.length; t += 2) {
          const c = turn[0] * part.tooth[t] - turn[1] * part.tooth[t + 1], s = turn[0] * part.tooth[t + 1] + turn[1] * part.tooth[t];
          const corner = (k) => [c * point[3 * k] - s * point[3 * k + 1] + centre[0], s * point[3 * k] + c * point[3 * k + 1] + centre[1], point[3 * k + 2] + centre[2]];
          for (let k = 0; k < index.length; k += 3) {
            const a = corner(index[k]), b = corner(index[k + 1]), d = corner(index[k + 2]);
            const n = cross(b.map((one, m) => one - a[m]), d.map((one, m) => one - a[m])), to = seen.eye.map((one, m) => one - a[m]);
            if (dot(n, to) <= 0) continue;
            const size = Math.hypot(...n), bright = 0.38 + 0.45 * Math.max(0, dot(n, light) / size) + 0.25 * dot(n, to) / size / Math.hypot(...to);
            faces.push([Math.hypot(...[0, 1, 2].map((m) => (a[m] + b[m] + d[m]) / 3 - seen.eye[m])), [a, b, d], `rgb(${rgb.map((one) => Math.round(255 * Math.min(1, one * bright))).join(",")})`]);
          }
        }
      }
      faces.sort((one, other) => other[0] - one[0]);
      context.lineWidth = 0.7;
      for (const [, corners, fill] of faces) {
        context.beginPath();
        for (const corner of corners) context.lineTo(...flat(corner));
        context.closePath();
        context.fillStyle = context.strokeStyle = fill;
        context.fill();
        context.stroke();  // no light between neighbours
      }
    });
  }
  // of a point where it is seen, px from the top left
  function project(seen, width, height) {
    const m = seen.matrix;
    return (p) => {
      const [x, y, , w] = [0, 1, 2, 3].map((k) => m[k] * p[0] + m[4 + k] * p[1] + m[8 + k] * p[2] + m[12 + k]);
      return [width * (0.5 + 0.5 * x / w), height * (0.5 - 0.5 * y / w)];
    };
  }

  // the section of a page: `files` are binary glTF, compressed by gzip; shows one of them
  function section(root, files) {
    const $ = (name) => root.querySelector("." + name), canvas = root.querySelector("canvas"), names = $("space-names");
    const view = { yaw: VIEWS.oblique[0], pitch: VIEWS.oblique[1], target: [0, 0, 0], distance: 1, fitted: 1, size: 1 };
    let parts = [], known = [], turned = 0, turning = false, last = 0, waits = false, marked = null, draw = null, file = null;
    const opened = typeof DecompressionStream !== "function" ? [] : files.map(async (text) => {
      const bytes = Uint8Array.from(atob(text), (one) => one.charCodeAt(0));
      return new Response(new Blob([bytes]).stream().pipeThrough(new DecompressionStream("gzip"))).arrayBuffer();
    });
    const colors = (part) => part === marked ? part.mesh.color.map((one) => 0.45 * one + 0.55) : part.mesh.color;
    function picture() {
      waits = false;
      if (!parts.length || root.hidden) return;
      const ratio = Math.min(2, window.devicePixelRatio || 1), width = Math.round((canvas.clientWidth || 900) * ratio), height = Math.round((canvas.clientHeight || 560) * ratio);
      if (canvas.width !== width || canvas.height !== height) { canvas.width = width; canvas.height = height; }
      draw(parts, view, turned, colors);
      named(camera(view, width / height));
      canvas.dataset.view = JSON.stringify([view.yaw, view.pitch, view.distance / view.fitted, ...view.target]);
      canvas.dataset.turned = String(turned);
    }
    // names above their parts, those nearer to the eye first; none over another but of the one that is pointed at
    function named(seen) {
      const flat = project(seen, canvas.clientWidth, canvas.clientHeight), across = Math.hypot(seen.up[0], seen.up[1]) || 1, taken = [];
      const places = parts.map((part) => {
        const { centre } = placed(part, turned), z = centre[2] + (part.mesh.low + part.mesh.high) / 2;
        return [part, [centre[0] + part.mesh.radius * seen.up[0] / across, centre[1] + part.mesh.radius * seen.up[1] / across, z]];
      });
      const far = ([part, place]) => part === marked ? 0 : Math.hypot(...place.map((one, k) => one - seen.eye[k]));
      for (const [part, place] of places.sort((one, other) => far(one) - far(other))) {
        part.label.hidden = !part.visible || !($("space-named").checked || part === marked);
        if (part.label.hidden) continue;
        const [x, y] = flat(place), half = part.label.offsetWidth / 2, high = part.label.offsetHeight;
        part.label.style.transform = `translate(${x - half}px, ${y - high}px)`;
        part.label.hidden = taken.some(([u, v, wide]) => Math.abs(x - u) < half + wide && Math.abs(y - v) < high);
        if (!part.label.hidden) taken.push([x, y, half]);
      }
    }
    const redraw = () => { if (!waits) { waits = true; requestAnimationFrame(picture); } };
    const fit = () => { fitted(parts, view, (canvas.clientWidth || 900) / (canvas.clientHeight || 560), turned); redraw(); };
    function orbit(x, y) {
      view.yaw += x;
      view.pitch = Math.min(Math.PI / 2, Math.max(-Math.PI / 2, view.pitch + y));
      redraw();
    }
    // by px of the canvas, to the right and down
    function pan(x, y) {
      const [right, up] = axes(view), scale = 2 * WIDE * view.distance / (canvas.clientHeight || 560);
      view.target = view.target.map((one, k) => one - scale * (x * right[k] - y * up[k]));
      redraw();
    }
    function zoom(factor) {
      view.distance = Math.min(FARTHEST * view.fitted, Math.max(NEAREST * view.fitted, view.distance * factor));
      redraw();
    }
    function tick(now) {
      if (!turning) return;
      // the fastest part takes four seconds
      turned += (now - last) / 4000 * 2 * Math.PI * Number($("space-speed").value) / Math.max(1e-9, ...parts.map((part) => Math.abs(part.turns)));
      last = now;
      redraw();
      requestAnimationFrame(tick);
    }
    const still = window.matchMedia ? window.matchMedia("(prefers-reduced-motion: reduce)") : { matches: false };
    function turn(on) {
      if (on && still.matches) {  // a tooth of the first gear further, at once
        turned += 2 * Math.PI / (parts[0].teeth || 24) / Math.abs(parts[0].turns || 1);
        return redraw();
      }
      if (on && !turning) { last = performance.now(); requestAnimationFrame(tick); }
      turning = on;
      $("space-turn").textContent = on ? "❚❚ Stop" : still.matches ? "Turn by a tooth" : "▶ Turn";
    }
    function listed() {
      const body = $("space-parts").tBodies[0] || $("space-parts").createTBody(), most = parts[0].turns || 1;
      body.textContent = names.textContent = "";
      for (const part of parts) {
        const row = body.insertRow(), label = document.createElement("label"), box = document.createElement("input"), swatch = document.createElement("i");
        box.type = "checkbox";
        box.checked = part.visible;
        box.onchange = () => { part.visible = box.checked; redraw(); };
        swatch.style.background = `rgb(${part.mesh.color.map((one) => Math.round(255 * one)).join(",")})`;
        label.append(box, swatch, part.name);
        row.insertCell().append(label);
        row.insertCell().textContent = part.teeth ? String(part.teeth) : "";
        row.insertCell().textContent = String(Number((part.turns / most).toPrecision(5))).replace("-", "−");
        row.onpointerenter = () => { marked = part; redraw(); };
        row.onpointerleave = () => { marked = null; redraw(); };
        part.label = document.createElement("span");
        part.label.textContent = part.name;
        names.append(part.label);
      }
      canvas.setAttribute("aria-label", "Picture in space of " + parts.map((part) => part.name).join(", ") + "; the list has their teeth and turns");
    }
    async function show(number) {
      if (opened.length) {
        file = await opened[number];
        parts = known[number] = known[number] || read(file);
        draw = draw || byWebGl(canvas) || byPainter(canvas);
      }
      if (!draw) { canvas.hidden = true; $("space-none").hidden = false; return; }
      listed();
      fit();
      picture();
    }
    for (const name of Object.keys(VIEWS)) $("space-view").add(new Option(name, name));
    $("space-view").onchange = (event) => { [view.yaw, view.pitch] = VIEWS[event.target.value]; fit(); };
    $("space-fit").onclick = fit;
    $("space-turn").onclick = () => turn(!turning);
    $("space-named").onchange = redraw;
    $("space-save").onclick = () => {
      const link = document.createElement("a");
      link.href = URL.createObjectURL(new Blob([file], { type: "model/gltf-binary" }));
      link.download = document.title.replace(/[^\w-]+/g, "-") + ".glb";
      link.click();
      setTimeout(() => URL.revokeObjectURL(link.href), 1000);
    };
    const fingers = new Map();
    canvas.onpointerdown = (event) => { canvas.focus({ preventScroll: true }); canvas.setPointerCapture(event.pointerId); fingers.set(event.pointerId, [event.clientX, event.clientY]); };
    canvas.onpointerup = canvas.onpointercancel = (event) => fingers.delete(event.pointerId);
    canvas.oncontextmenu = (event) => event.preventDefault();
    canvas.onpointermove = (event) => {
      const before = fingers.get(event.pointerId), after = [event.clientX, event.clientY];
      if (!before) return;
      const x = after[0] - before[0], y = after[1] - before[1], other = [...fingers].find(([id]) => id !== event.pointerId);
      fingers.set(event.pointerId, after);
      if (other) {  // two fingers: both move it by half, their distance zooms
        const apart = ([u, v]) => Math.max(1, Math.hypot(u - other[1][0], v - other[1][1]));
        pan(x / 2, y / 2);
        zoom(apart(before) / apart(after));
      } else if (event.buttons & 2 || event.buttons & 4 || event.shiftKey) pan(x, y);
      else orbit(x / 150, y / 150);
    };
    // only where it is looked at, so that a page can be scrolled past
    canvas.addEventListener("wheel", (event) => { if (document.activeElement === canvas) { event.preventDefault(); zoom(Math.exp(Math.sign(event.deltaY) * Math.min(Math.abs(event.deltaY), 100) / 500)); } }, { passive: false });
    canvas.addEventListener("keydown", (event) => {
      const move = { ArrowLeft: [-1, 0], ArrowRight: [1, 0], ArrowUp: [0, -1], ArrowDown: [0, 1] }[event.key];
      if (event.ctrlKey || event.altKey || event.metaKey) return;
      if (move) (event.shiftKey ? pan(-40 * move[0], -40 * move[1]) : orbit(STEP * move[0], STEP * move[1]));
      else if (event.key === "+" || event.key === "=") zoom(1 / 1.15);
      else if (event.key === "-") zoom(1.15);
      else if (["0", "f", "Home"].includes(event.key)) fit();
      else if (event.key === " ") turn(!turning);
      else return;
      event.preventDefault();
    });
    root.addEventListener("keydown", (event) => event.stopPropagation());  // keys here are not those of the run
    turn(false);
    still.onchange = () => turn(false);
    document.addEventListener("visibilitychange", () => { if (document.hidden) turn(false); });
    return { show: show, redraw: redraw, turn: turn };
  }
  return { read: read, section: section };
})();
