"use strict";
(function () {
  const data = JSON.parse(document.getElementById("data").textContent);
  const $ = (id) => document.getElementById(id);
  const COLORS = ["#0072B2", "#D55E00", "#009E73", "#CC79A7", "#E69F00", "#56B4E9"];
  const DASHES = ["solid", "dash", "dot", "dashdot"];
  function numbers(text, Kind) {
    const raw = atob(text), bytes = new Uint8Array(raw.length);
    for (let i = 0; i < raw.length; i++) bytes[i] = raw.charCodeAt(i);
    return new Kind(bytes.buffer);
  }
  function outlined(text, outside) {
    const points = numbers(text, Float32Array), outline = new Path2D();
    let starts = true;
    for (let k = 0; k < points.length; k += 2) {
      if (isNaN(points[k])) outline.closePath();
      else if (starts) outline.moveTo(points[k], points[k + 1]);
      else outline.lineTo(points[k], points[k + 1]);
      starts = isNaN(points[k]);
    }
    outline.closePath();
    if (outside) {  // of an internal gear, whose outline is its hole
      outline.moveTo(outside, 0);
      outline.arc(0, 0, outside, 0, 2 * Math.PI);
    }
    return outline;
  }
  // unpack the records
  for (const record of data.records) {
    record.axis = numbers(record.axis, Float64Array);
    record.byName = {};
    if (record.rates) record.rates = numbers(record.rates, Float32Array);
    for (const one of record.series) {
      record.byName[one.name] = one;
      for (const curve of one.curves) {
        curve.y = numbers(curve.y, Float32Array);
        curve.i = curve.i === null ? null : numbers(curve.i, Uint32Array);
        curve.x = curve.i === null ? record.axis : Float64Array.from(curve.i, (i) => record.axis[i]);
      }
    }
    for (const one of record.maps || []) for (const name of ["x", "y", "z"]) one[name] = numbers(one[name], Float32Array);
    if (record.profiles) {
      record.profiles.x = numbers(record.profiles.x, Float32Array);
      for (const row of record.profiles.rows) row.y = numbers(row.y, Float32Array);
    }
    if (record.solid) record.solid = solids.unpacked(record.solid, numbers);
    const teeth = record.teeth;
    if (teeth) {
      teeth.frames = teeth.frames && numbers(teeth.frames, Uint32Array);
      for (const name of ["x", "y", "alpha"]) teeth[name] = numbers(teeth[name], Float32Array);
      if (teeth.bodies) {
        for (const body of teeth.bodies) {
          const pose = numbers(body.pose, Float32Array);
          body.path = outlined(body.outline);
          body.pose = (frame) => pose.subarray(3 * frame, 3 * frame + 3);
        }
      } else {
        teeth.roll = numbers(teeth.roll, Float64Array);
        teeth.path = numbers(teeth.path, Float32Array);
        const turns = { pinion: -1, gear: teeth.radii[0] / teeth.radii[1] }, places = { pinion: -teeth.radii[0], gear: teeth.radii[1] };
        teeth.bodies = ["pinion", "gear"].map((name, n) => ({
          path: outlined(teeth[name], teeth.outside[n]), fill: name, pose: (frame) => [0, places[name], turns[name] * teeth.roll[frame]],
        }));
      }
    }
  }
  const first = data.records[0];
  let shown = data.panels.filter((name) => first.byName[name]);
  let which = 0, at = first.start, playing = false, last = 0, turned = 0;
  const span = () => [first.axis[0], first.axis[first.axis.length - 1]];
  let range = first.window;

  function indexAt(axis, value) {
    let low = 0, high = axis.length - 1;
    while (high - low > 1) {
      const middle = (low + high) >> 1;
      if (axis[middle] <= value) low = middle; else high = middle;
    }
    return value - axis[low] <= axis[high] - value ? low : high;
  }
  const valueAt = (curve) => curve.y[indexAt(curve.x, at)];
  function written(value) {
    if (!isFinite(value)) return "–";
    const size = Math.abs(value);
    return size >= 1e5 || (size > 0 && size < 1e-3) ? value.toExponential(3) : value.toPrecision(5);
  }
  // plotly reads tags in its texts
  const plain = (text) => text.replace(/&/g, "&amp;").replace(/</g, "&lt;");
  const several = data.records.length > 1;
  // of many curves colours along the hues, so that neighbours are alike
  const colorOf = (number, k, count) => several ? COLORS[number % COLORS.length] : count > COLORS.length ? "hsl(" + Math.round(270 - 270 * k / (count - 1)) + " 75% 45%)" : COLORS[k % COLORS.length];
  // words of a title, [text, colour] each
  const words = (text, color) => text.split(" ").filter(Boolean).map((word) => [word, color]);
  const named = (text, color) => [[text, color]];
  // into lines of a width, px: how many, and as plotly reads them
  function wrapped(pieces, width) {
    const most = Math.max(12, Math.floor(width / 6.4)), lines = [];
    let room = -1;
    for (const [text, color] of pieces) {
      const short = text.length > most ? text.slice(0, most - 1) + "…" : text;
      if (short.length + 1 > room) { lines.push([]); room = most; }
      room -= short.length + 1;
      lines[lines.length - 1].push(color ? '<span style="color:' + color + '">' + plain(short) + "</span>" : plain(short));
    }
    return { count: lines.length, html: lines.map((line) => line.join(" ")).join("<br>") };
  }
  function heading(series, width) {
    const names = several ? data.records.map((one) => one.label) : series.curves.length > 1 ? series.curves.map((one) => one.label) : [];
    const pieces = words(series.title);
    if (names.length > 8) pieces.push(...named(names[0] + " … " + names[names.length - 1], "#808080"));
    else names.forEach((name, k) => pieces.push(...named("\u00a0" + name, COLORS[k % COLORS.length])));
    if (data.records.some((one) => (one.outside || {})[series.name])) pieces.push(...words("(shaded: " + (data.shaded || "its law is extrapolated") + ")"));
    if (data.records.some((one) => one.trust)) pieces.push(...named("outside the model", "#b3261e"));
    return wrapped(pieces, width);
  }
  // rows from the top, px: lines of a title, then so high a panel, then a gap; their places as shares of all
  function stacked(rows, gap) {
    const inner = rows.reduce((sum, row) => sum + 16 * row.lines + 8 + row.high + gap, 0) - gap;
    let y = 0;
    const places = rows.map((row) => {
      y += 16 * row.lines + 8;
      const place = [Math.max(0, 1 - (y + row.high) / inner), 1 - y / inner];
      y += row.high + gap;
      return place;
    });
    return { inner: inner, places: places };
  }
  // on paper, px: the width between the margins of A4
  const PAPER = 690;
  let onPaper = false;
  const widthOf = (id) => onPaper ? PAPER : $(id).clientWidth || 900;
  const style = () => {
    const found = getComputedStyle(document.documentElement), color = (name) => found.getPropertyValue(name).trim();
    return { ink: color("--ink"), grid: color("--line") };
  };
  const basis = (id, left, right, ink) => ({
    width: widthOf(id), margin: { l: left, r: right, t: 34, b: 48 }, paper_bgcolor: "rgba(0,0,0,0)", plot_bgcolor: "rgba(0,0,0,0)",
    font: { color: ink, size: 12 }, showlegend: false, annotations: [], shapes: [],
  });
  const title = (text, x, y) => ({
    text: text, x: x, y: y, xref: "paper", yref: "paper", xanchor: "left", yanchor: "bottom", align: "left", showarrow: false,
  });
  // what is seen fills its axis; of a constant some room about it
  function fitted(name) {
    let low = Infinity, high = -Infinity;
    for (const record of data.records) for (const curve of (record.byName[name] || { curves: [] }).curves)
      for (let k = 0; k < curve.y.length; k++)
        if (isFinite(curve.y[k]) && curve.x[k] >= range[0] && curve.x[k] <= range[1]) { low = Math.min(low, curve.y[k]); high = Math.max(high, curve.y[k]); }
    if (low > high) return undefined;
    const size = Math.max(Math.abs(low), Math.abs(high));
    const room = high - low > 1e-5 * size ? 0.06 * (high - low) : 0.05 * size || 1;
    return [low - room, high + room];
  }
  // ---- figures
  function draw() {
    if (!data.figures) return;
    const { ink, grid } = style(), traces = [], count = shown.length, width = widthOf("figures"), left = width < 600 ? 52 : 75;
    const layout = Object.assign(basis("figures", left, 14, ink), {
      hovermode: "x unified",
      xaxis: { title: { text: data.axis }, range: range, gridcolor: grid, zeroline: false, anchor: count > 1 ? "y" + count : "y" },
    });
    const titles = shown.map((name) => heading(first.byName[name], width - left - 14));
    const { inner, places } = stacked(titles.map((one) => ({ lines: one.count, high: 150 })), 10);
    layout.height = inner + 82;
    shown.forEach((name, row) => {
      const key = row === 0 ? "" : String(row + 1), series = first.byName[name];
      layout["yaxis" + key] = {
        domain: places[row], range: fitted(name), nticks: 5, title: { text: plain(series.unit) }, gridcolor: grid, zeroline: false, anchor: "x",
      };
      layout.annotations.push(title(titles[row].html, 0, places[row][1]));
      data.records.forEach((record, number) => {
        const one = record.byName[name];
        if (!one) return;
        for (const [from, to] of (record.outside || {})[name] || [])
          layout.shapes.push({
            type: "rect", xref: "x", yref: "y" + key + " domain", x0: record.axis[from], x1: record.axis[to], y0: 0, y1: 1,
            fillcolor: several ? COLORS[number % COLORS.length] : "#e69f00", opacity: 0.13, line: { width: 0 }, layer: "below",
          });
        one.curves.forEach((curve, k) => {
          const label = [several ? record.label : "", curve.label || (several ? "" : series.unit)];
          traces.push({
            type: "scatter", mode: "lines", x: curve.x, y: curve.y, xaxis: "x", yaxis: "y" + key, connectgaps: false,
            name: plain(label.filter(Boolean).join(", ")),
            line: { width: 1.3, color: colorOf(number, k, one.curves.length), dash: several ? DASHES[k % DASHES.length] : "solid" },
          });
        });
      });
    });
    Plotly.react($("plot"), traces, layout, { displaylogo: false, scrollZoom: false });
    mark();
  }
  function mark() {
    const full = $("plot")._fullLayout, line = $("line");
    if (!full || !full.xaxis) return;
    const x = full.xaxis._offset + full.xaxis.d2p(at);
    line.style.display = x >= full.xaxis._offset - 1 && x <= full.xaxis._offset + full.xaxis._length + 1 ? "block" : "none";
    line.style.left = x + "px";
    line.style.height = full.height - 48 + "px";
  }
  // ---- maps over the face
  const withMaps = data.records.filter((one) => one.maps && one.maps.length);
  const mapNames = withMaps.length ? withMaps[0].maps.map((one) => one.name) : [];
  let mapPairs = [];
  function drawMaps() {
    $("maps-section").hidden = !withMaps.length;
    if (!withMaps.length) return;
    const { ink } = style(), width = widthOf("maps"), columns = width < 640 ? 1 : withMaps.length, traces = [];
    const layout = basis("maps", 60, 84, ink), cells = [];
    mapNames.forEach((_, row) => withMaps.forEach((record) => cells.push([record, record.maps[row], row])));
    const across = (width - 144) / columns - 12;
    const titles = cells.map(([record, one]) => wrapped(words(one.title + (several ? ": " + record.label : "")), across));
    const lines = [];
    titles.forEach((one, n) => { const row = Math.floor(n / columns); lines[row] = Math.max(lines[row] || 1, one.count); });
    const { inner, places } = stacked(lines.map((count) => ({ lines: count, high: 180 })), 48);
    layout.height = inner + 82;
    mapPairs = [];
    cells.forEach(([record, one, row], n) => {
        const key = n ? String(n + 1) : "", column = n % columns, z = [];
        const top = Math.max(...withMaps.map((other) => other.maps[row].top));
        for (let k = 0; k < one.y.length; k++) z.push(one.z.subarray(k * one.x.length, (k + 1) * one.x.length));
        const left = column / columns, right = columns > 1 ? (column + 0.9) / columns : 1, place = places[Math.floor(n / columns)], [low, high] = place;
        layout["xaxis" + key] = { domain: [left, right], anchor: "y" + key, title: { text: n >= cells.length - columns ? "Roll angle from the pitch point (°)" : "" } };
        layout["yaxis" + key] = { domain: place, anchor: "x" + key, title: { text: column ? "" : "Place on the face (mm)" } };
        layout.annotations.push(title(titles[n].html, left, high));
        traces.push({
          type: "heatmap", x: one.x, y: one.y, z: z, xaxis: "x" + key, yaxis: "y" + key, zmin: 0, zmax: top, colorscale: "Viridis", zsmooth: one.y.length > 1 ? "best" : false,
          showscale: column === columns - 1, colorbar: { title: { text: plain(one.unit) }, thickness: 16, len: high - low, y: (low + high) / 2 },
          hovertemplate: "%{x:.3g}°, %{y:.3g} mm: %{z:.4g} " + plain(one.unit) + "<extra></extra>",
        });
        mapPairs.push([record, key]);
    });
    Plotly.react($("maps"), traces, layout, { displaylogo: false }).then(markMaps);
  }
  let waiting = false;
  function markMaps() {
    if (!withMaps.length || waiting) return;
    waiting = true;
    requestAnimationFrame(() => {
      waiting = false;
      const shapes = [];
      for (const [record, key] of mapPairs) {
        const roll = record.byName.roll_angle;
        if (!roll) continue;
        const ends = $("maps")._fullLayout["xaxis" + key].range;
        for (const curve of roll.curves) {
          const x = valueAt(curve);
          if (x >= ends[0] && x <= ends[1]) shapes.push({ type: "line", xref: "x" + key, yref: "y" + key + " domain", x0: x, x1: x, y0: 0, y1: 1, line: { color: "white", width: 2 } });
        }
      }
      Plotly.relayout($("maps"), { shapes: shapes });
    });
  }
  // ---- profiles at the cursor
  const withProfiles = data.records.filter((one) => one.profiles);
  const profileAt = (record, row) => {
    const count = record.profiles.x.length, from = indexAt(record.axis, at) * count;
    return record.profiles.rows[row].y.subarray(from, from + count);
  };
  function drawProfiles() {
    $("profiles-section").hidden = !withProfiles.length;
    if (!withProfiles.length) return;
    const { ink, grid } = style(), rows = withProfiles[0].profiles.rows, traces = [], width = widthOf("profiles");
    const columns = width < 640 ? 1 : 2, share = columns > 1 ? 0.47 : 1, layout = basis("profiles", 60, 14, ink);
    const titles = rows.map((row) => wrapped(words(row.title), share * (width - 74))), lines = [];
    titles.forEach((one, n) => { const row = Math.floor(n / columns); lines[row] = Math.max(lines[row] || 1, one.count); });
    const { inner, places } = stacked(lines.map((count) => ({ lines: count, high: 165 })), 36);
    const below = wrapped(words(withProfiles[0].profiles.label), share * (width - 74));
    layout.margin.b = 36 + 14 * below.count;
    layout.height = inner + 34 + layout.margin.b;
    $("profiles-title").textContent = withProfiles[0].profiles.title;
    rows.forEach((row, n) => {
      const key = n ? String(n + 1) : "", left = (n % columns) * 0.53, place = places[Math.floor(n / columns)];
      let top = 0, bottom = 0;
      for (const record of withProfiles) { top = Math.max(top, record.profiles.rows[n].high); bottom = Math.min(bottom, record.profiles.rows[n].low); }
      layout["xaxis" + key] = { domain: [left, left + share], anchor: "y" + key, gridcolor: grid, zeroline: false, title: { text: n >= rows.length - columns ? below.html : "", font: { size: 11 } } };
      layout["yaxis" + key] = { domain: place, anchor: "x" + key, gridcolor: grid, zeroline: false, range: [1.05 * bottom, 1.05 * top], title: { text: plain(row.unit) } };
      layout.annotations.push(title(titles[n].html, left, place[1]));
      withProfiles.forEach((record, number) => traces.push({
        type: "scatter", mode: "lines", x: record.profiles.x, y: profileAt(record, n), xaxis: "x" + key, yaxis: "y" + key, connectgaps: false,
        name: plain(record.label), line: { width: 1.5, color: COLORS[number % COLORS.length] },
      }));
    });
    Plotly.react($("profiles"), traces, layout, { displaylogo: false });
  }
  let profiled = -1;
  function moveProfiles() {
    if (!withProfiles.length) return;
    requestAnimationFrame(() => {
      const sample = indexAt(first.axis, at);
      if (sample === profiled) return;
      profiled = sample;
      const values = [];
      withProfiles[0].profiles.rows.forEach((row, n) => withProfiles.forEach((record) => values.push(profileAt(record, n))));
      Plotly.restyle($("profiles"), { y: values });
      document.body.dataset.profiled = String(sample);
    });
  }
  // ---- teeth
  function drawTeeth() {
    const record = data.records[which], teeth = record.teeth, canvas = $("teeth");
    if (!teeth) return;
    const context = canvas.getContext("2d"), style = getComputedStyle(document.documentElement);
    const color = (name) => style.getPropertyValue(name).trim();
    const ratio = window.devicePixelRatio || 1, width = Math.round((canvas.clientWidth || 900) * ratio);
    if (canvas.width !== width) { canvas.width = width; canvas.height = Math.round(0.66 * width); }
    const sample = indexAt(record.axis, at), frame = teeth.turning ? Math.floor(turned * teeth.roll.length) % teeth.roll.length : teeth.frames ? indexAt(teeth.frames, sample) : sample;
    let across = 1e-9;
    for (let k = 0; k < (teeth.path || []).length; k += 2) across = Math.max(across, Math.abs(teeth.path[k]), 1.4 * Math.abs(teeth.path[k + 1]));
    const sight = (teeth.sights || [])[Number($("sight").value)] || { x: 0, y: 0, reach: teeth.reach }, nearer = sight.reach / teeth.reach;
    const scale = teeth.reach ? canvas.height / 2 / sight.reach : canvas.width / 2 / (1.75 * across);
    context.setTransform(1, 0, 0, 1, 0, 0);
    context.clearRect(0, 0, canvas.width, canvas.height);
    const [aboutX, aboutY, carrier] = sight.turns || [0, 0, -1], carried = carrier >= 0 ? teeth.bodies[carrier].pose(frame)[2] : 0;
    const world = () => {
      context.setTransform(scale, 0, 0, -scale, canvas.width / 2 - scale * sight.x, canvas.height / 2 + scale * sight.y);
      context.translate(aboutX, aboutY);
      context.rotate(-carried);
      context.translate(-aboutX, -aboutY);
    };
    const edges = { pinion: COLORS[0], gear: COLORS[1], paper: color("--ink"), ring: color("--ring") };
    const front = (sight.front || []).map((number) => teeth.bodies[number]);
    for (const body of teeth.bodies.filter((one) => !front.includes(one)).concat(front)) {
      const [x, y, angle] = body.pose(frame);
      world();
      context.translate(x, y);
      context.rotate(angle);
      context.fillStyle = color(body.fill === "paper" ? "--card" : "--" + body.fill);
      context.globalAlpha = body.opacity || 1;
      if (body.fill !== "ring") context.fill(body.path, "evenodd");
      context.globalAlpha = 1;
      context.lineWidth = body.width || 1.4 * ratio / scale;
      context.strokeStyle = edges[body.fill];
      context.stroke(body.path);
    }
    world();
    if (teeth.path) {
      context.beginPath();
      for (let k = 0; k < teeth.path.length; k += 2) context.lineTo(teeth.path[k], teeth.path[k + 1]);
      context.lineWidth = 1.6 * ratio / scale;
      context.strokeStyle = color("--ink");
      context.stroke();
    }
    const loads = record.byName[data.load], tint = record.byName[$("color").value];
    if (teeth.turning) for (let q = 0; q < teeth.pairs; q++) {
      const x = teeth.x[frame * teeth.pairs + q], y = teeth.y[frame * teeth.pairs + q];
      if (isFinite(x)) arrow(context, x, y, 0, 0, 1, ratio / scale);
    }
    if (!loads) return;
    let largest = 1e-30, lowest = Infinity, highest = -Infinity;
    for (const curve of loads.curves) for (const y of curve.y) if (y > largest) largest = y;
    if (tint) for (const curve of tint.curves) for (const y of curve.y) if (isFinite(y)) { lowest = Math.min(lowest, y); highest = Math.max(highest, y); }
    const pairs = teeth.pairs;
    for (let q = 0; q < pairs; q++) {
      const x = teeth.x[frame * pairs + q], y = teeth.y[frame * pairs + q], alpha = teeth.alpha[frame * pairs + q];
      if (!isFinite(x)) continue;
      // of pairs of gears the curves stand newest first, the slots oldest first
      const place = teeth.longest ? q : pairs - 1 - q, load = valueAt(loads.curves[place] || loads.curves[0]);
      if (teeth.longest && !(load > 1e-9 * largest)) continue;
      const share = tint ? (valueAt(tint.curves[place] || tint.curves[0]) - lowest) / (highest - lowest || 1) : 1;
      arrow(context, x, y, alpha, (load / largest) * (teeth.longest * nearer || 0.55 * across), share, ratio / scale);
    }
  }
  function arrow(context, x, y, alpha, length, share, pixel) {
    const c = Math.cos(alpha), s = Math.sin(alpha), hue = 240 - 240 * Math.min(1, Math.max(0, share || 0));
    context.strokeStyle = context.fillStyle = "hsl(" + hue + " 85% 45%)";
    context.lineWidth = 2.6 * pixel;
    if (length > 0) {
      const tip = [x + length * c, y + length * s], head = Math.min(10 * pixel, 0.4 * length);
      context.beginPath(); context.moveTo(x, y); context.lineTo(tip[0], tip[1]); context.stroke();
      context.beginPath(); context.moveTo(tip[0], tip[1]);
      context.lineTo(tip[0] - head * c + 0.5 * head * s, tip[1] - head * s - 0.5 * head * c);
      context.lineTo(tip[0] - head * c - 0.5 * head * s, tip[1] - head * s + 0.5 * head * c);
      context.closePath(); context.fill();
    }
    context.beginPath(); context.arc(x, y, 3.5 * pixel, 0, 7); context.fill();
  }
  // ---- bodies in space
  const bodies = (data.bodies || []).length ? space.section($("space-section"), data.bodies) : { redraw: () => {}, show: () => {} };
  function drawBodies() {
    const own = data.records[which].bodies;
    $("space-section").hidden = own === undefined;
    if (own !== undefined) bodies.show(own);
  }
  // ---- shafts bent
  const view = { yaw: -0.6, pitch: 0.3 };
  let waits = false;
  function drawSolid() {
    const record = data.records[which], solid = record.solid;
    $("solid-section").hidden = !solid;
    if (!solid || waits) return;
    waits = true;
    requestAnimationFrame(() => {
      waits = false;
      const found = getComputedStyle(document.documentElement), sample = indexAt(record.axis, at);
      const times = solid.times * Number($("solid-factor").value);
      $("solid-times").textContent = times ? "displacements × " + times : "displacements not drawn";
      solids.draw($("solid"), solid, solid.frames ? indexAt(solid.frames, sample) : sample, times, view, (name) => found.getPropertyValue(name).trim());
      document.body.dataset.solid = String(sample);
    });
  }
  function read() {
    const table = $("readings"), record = data.records[which];
    $("where").textContent = data.axis + " " + written(at);
    table.textContent = "";
    for (const name of shown) {
      const series = record.byName[name];
      if (!series) continue;
      for (const curve of series.curves.length > 8 ? [] : series.curves) {
        const row = table.insertRow();
        row.insertCell().textContent = series.short + (curve.label ? ", " + curve.label : "");
        row.insertCell().textContent = written(valueAt(curve)) + (series.unit ? " " + series.unit : "");
      }
    }
  }
  function redraw() { draw(); drawTeeth(); drawSolid(); drawMaps(); drawProfiles(); bodies.redraw(); }
  function move(value, fromSlider) {
    const [low, high] = span();
    at = Math.min(high, Math.max(low, value));
    if (!fromSlider) $("cursor").value = String(Math.round(1000 * (at - range[0]) / (range[1] - range[0])));
    mark(); drawTeeth(); drawSolid(); read(); markMaps(); moveProfiles();
    document.body.dataset.at = String(at);
    document.body.dataset.line = $("line").style.left;
  }
  function choose(select, options) {
    for (const [value, text] of options) {
      const option = document.createElement("option");
      option.value = value; option.textContent = text;
      select.appendChild(option);
    }
  }
  function offer() {
    $("add").textContent = "";
    choose($("add"), [["", "…"]].concat(first.series.filter((one) => !shown.includes(one.name)).map((one) => [one.name, one.short])));
  }
  function tick(now) {
    if (!playing) return;
    // a mesh cycle, or a twentieth of what is shown, takes four seconds
    const share = (now - last) / 4000 * Number($("speed").value);
    last = now;
    // of cases side by side the cursor stays at one, whose teeth turn: the fastest by a tooth in four seconds
    if (first.teeth && first.teeth.turning) {
      turned = (turned + share * first.rates[indexAt(first.axis, at)]) % 1;
      drawTeeth();
      requestAnimationFrame(tick);
      return;
    }
    const step = share * first.cycle;
    let next = at + step;
    if (next > range[1]) next = range[0];
    move(next);
    requestAnimationFrame(tick);
  }
  $("play").onclick = () => { playing = !playing; $("play").textContent = playing ? "❚❚" : "▶"; last = performance.now(); if (playing) requestAnimationFrame(tick); };
  $("cursor").oninput = (event) => move(range[0] + Number(event.target.value) / 1000 * (range[1] - range[0]), true);
  $("add").onchange = (event) => { if (event.target.value) { shown.push(event.target.value); offer(); draw(); read(); } };
  $("view").onchange = (event) => { range = event.target.value === "all" ? span() : first.window; draw(); move(Math.max(range[0], Math.min(range[1], at))); };
  $("color").onchange = drawTeeth;
  $("sight").onchange = drawTeeth;
  $("solid-factor").onchange = drawSolid;
  $("solid").onpointerdown = (event) => $("solid").setPointerCapture(event.pointerId);
  $("solid").onpointermove = (event) => {
    if (!event.buttons) return;
    view.yaw += event.movementX / 150;
    view.pitch = Math.min(1.5, Math.max(-1.5, view.pitch + event.movementY / 150));
    drawSolid();
  };
  $("which").onchange = (event) => { which = Number(event.target.value); looks(); move(at); drawBodies(); };
  $("theme").onclick = () => { const root = document.documentElement; root.dataset.theme = root.dataset.theme === "dark" ? "light" : "dark"; redraw(); };
  document.addEventListener("keydown", (event) => {
    if (["SELECT", "INPUT"].includes(event.target.tagName) && event.key !== " ") return;
    const step = { ArrowLeft: -1, ArrowRight: 1 }[event.key];
    if (step) { const axis = first.axis; move(axis[Math.min(axis.length - 1, Math.max(0, indexAt(axis, at) + step * (event.shiftKey ? 10 : 1)))]); event.preventDefault(); }
    if (event.key === " " && moving) { $("play").onclick(); event.preventDefault(); }
  });
  document.documentElement.dataset.theme = window.matchMedia && window.matchMedia("(prefers-color-scheme: dark)").matches ? "dark" : "light";
  choose($("view"), [["window", "the last mesh cycles"], ["all", "the whole run"]]);
  if (first.window[0] <= span()[0] && first.window[1] >= span()[1]) $("view").parentElement.hidden = true;
  choose($("color"), first.series.filter((one) => one.curves.length > 1).map((one) => [one.name, one.short]));
  if (first.byName[data.load]) $("color").value = data.load;
  const bent = ((data.records.find((one) => one.solid) || {}).solid || {}).times;
  choose($("solid-factor"), [1, 4, 0.25, 0].map((share) => [String(share), share ? "× " + share * bent : "none"]));
  choose($("which"), data.records.map((one, k) => [String(k), one.label]));
  const looks = () => {
    const sights = (data.records[which].teeth || {}).sights || [];
    $("sight").textContent = "";
    choose($("sight"), sights.map((one, k) => [String(k), one.label]));
    $("sight-label").hidden = !sights.length;
  };
  looks();
  $("which-label").hidden = data.records.length < 2;
  if (first.teeth && first.teeth.title) $("teeth-title").textContent = first.teeth.title;
  const moving = data.records.some((one) => one.teeth || one.solid || one.profiles || (one.maps || []).length);
  if (!moving) document.querySelector(".controls").hidden = true;
  $("color").parentElement.hidden = !first.byName[data.load];
  if (first.teeth && first.teeth.turning) {
    document.querySelector(".controls .keys").textContent = "The slider chooses a case; play turns its teeth in slow motion: the fastest by a tooth in four seconds.";
    $("teeth-title").textContent = "The teeth of the scenario that is varied";
  }
  $("teeth-section").hidden = !data.records.some((one) => one.teeth);
  // page.html#at=1.25 opens there
  const asked = Number(new URLSearchParams(location.hash.slice(1)).get("at") || NaN);
  offer(); draw(); drawMaps(); drawProfiles(); drawBodies(); move(isFinite(asked) ? asked : at);
  if (data.figures) {
    $("plot").on("plotly_hover", (event) => { if (!playing) move(event.points[0].x); });
    $("plot").on("plotly_relayout", mark);
  } else document.body.classList.add("teeth-alone");
  let across = widthOf("figures");
  const resized = () => { if (!onPaper && widthOf("figures") !== across) { across = widthOf("figures"); redraw(); } };
  window.addEventListener("resize", resized);
  new ResizeObserver(() => requestAnimationFrame(resized)).observe($("figures"));  // a scroll bar came or went
  let screenTheme = "";
  window.addEventListener("beforeprint", () => { onPaper = true; screenTheme = document.documentElement.dataset.theme; document.documentElement.dataset.theme = "light"; redraw(); });
  window.addEventListener("afterprint", () => { onPaper = false; document.documentElement.dataset.theme = screenTheme; redraw(); });
  document.body.dataset.ready = "yes";
})();
