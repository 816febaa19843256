"use strict";
// shafts, gears and bearings in space, bent by so many times what they are; m, y upwards, z along the shafts
const solids = (function () {
  const AROUND = 20, LIGHT = [0.35, 0.75, 0.55];
  const RGB = { pinion: [120, 180, 222], gear: [232, 170, 120], ring: [168, 176, 186], shaft: [203, 207, 213] };
  function unpacked(solid, numbers) {
    for (const name of ["station", "moved", "section", "bearing", "force", "carried"]) solid[name] = numbers(solid[name], Float32Array);
    solid.frames = solid.frames && numbers(solid.frames, Uint32Array);
    for (const disc of solid.discs) disc.pose = numbers(disc.pose, Float32Array);
    solid.most = solid.force.reduce((most, one) => Math.max(most, Math.abs(one)), 1e-30);
    // what is seen at most: circles about shafts, bearings and discs
    solid.outside = [];
    const circle = (x, y, z, radius) => { for (let k = 0; k < 12; k++) solid.outside.push([x + radius * Math.cos(k * Math.PI / 6), y + radius * Math.sin(k * Math.PI / 6), z]); };
    for (let k = 0; k < solid.station.length; k += 4) circle(...solid.station.subarray(k + 1, k + 4), 0.02);
    for (let k = 0; k < solid.bearing.length; k += 4) circle(...solid.bearing.subarray(k, k + 3), 1.6 * solid.bearing[k + 3]);
    for (const one of solid.discs) for (const way of [-0.5, 0.5]) circle(...one.centre, one.z + way * one.width, one.tip);
    const low = [0, 1, 2].map((k) => Math.min(...solid.outside.map((p) => p[k]))), high = [0, 1, 2].map((k) => Math.max(...solid.outside.map((p) => p[k])));
    solid.size = Math.hypot(...high.map((one, k) => one - low[k]));
    return solid;
  }
  // axes of sight: p -> [right, up, towards the eye]
  function sight(yaw, pitch) {
    const cy = Math.cos(yaw), sy = Math.sin(yaw), cp = Math.cos(pitch), sp = Math.sin(pitch);
    return ([x, y, z]) => {
      const deep = -x * sy + z * cy;
      return [x * cy + z * sy, y * cp - deep * sp, y * sp + deep * cp];
    };
  }
  function draw(canvas, solid, frame, times, view, color) {
    const context = canvas.getContext("2d"), ratio = window.devicePixelRatio || 1;
    const width = Math.round((canvas.clientWidth || 900) * ratio);
    if (canvas.width !== width) { canvas.width = width; canvas.height = Math.round(0.56 * width); }
    const seen = sight(view.yaw, view.pitch), ends = [0, 1].map((k) => {
      const places = solid.outside.map((p) => seen(p)[k]);
      return [Math.min(...places), Math.max(...places)];
    });
    const about = ends.map(([one, other]) => (one + other) / 2);
    const scale = 0.9 * Math.min(canvas.width / (ends[0][1] - ends[0][0]), canvas.height / (ends[1][1] - ends[1][0]));
    const flat = (p) => { const [x, y] = seen(p); return [canvas.width / 2 + scale * (x - about[0]), canvas.height / 2 - scale * (y - about[1])]; };
    context.clearRect(0, 0, canvas.width, canvas.height);
    const faces = [];
    // a face that looks at the eye, with its normal
    function face(points, normal, rgb, alpha, edge) {
      const depth = seen(normal)[2];
      if (depth <= 1e-6) return;
      const shade = 0.55 + 0.45 * Math.max(0, LIGHT[0] * normal[0] + LIGHT[1] * normal[1] + LIGHT[2] * normal[2]);
      let far = 0;
      for (const p of points) far += seen(p)[2] / points.length;
      faces.push([far, points, `rgba(${rgb.map((one) => Math.round(one * shade)).join(",")},${alpha})`, edge ? `rgb(${rgb.map((one) => Math.round(0.55 * one)).join(",")})` : null]);
    }
    // a point of a disc that is moved by d and tilted by tx, ty about x and y
    const placed = (centre, d, tx, ty, radius, angle, along) => {
      const rx = radius * Math.cos(angle), ry = radius * Math.sin(angle);
      return [centre[0] + times * (d[0] + ty * along) + rx, centre[1] + times * (d[1] - tx * along) + ry, centre[2] + times * (d[2] + tx * ry - ty * rx) + along];
    };
    const count = solid.station.length / 4, base = 3 * count * frame;
    const moved = (k) => Array.from(solid.moved.subarray(base + 3 * k, base + 3 * k + 3));
    const station = (k) => Array.from(solid.station.subarray(4 * k, 4 * k + 4));
    const nodes = [];
    for (let k = 0; k < count; k++) nodes.push({ at: station(k), d: moved(k) });
    nodes.forEach((node, k) => {
      const before = k && nodes[k - 1].at[0] === node.at[0] ? nodes[k - 1] : node;
      const after = k + 1 < count && nodes[k + 1].at[0] === node.at[0] ? nodes[k + 1] : node;
      const length = after.at[3] - before.at[3] || 1;
      node.ty = (after.d[0] - before.d[0]) / length;
      node.tx = -(after.d[1] - before.d[1]) / length;
    });
    const on = (node, radius, angle) => placed(node.at.slice(1), node.d, node.tx, node.ty, radius, angle, 0);
    for (let s = 0; s < solid.section.length; s += 4) {
      const [shaft, start, end, radius] = solid.section.subarray(s, s + 4);
      const inside = nodes.filter((one) => one.at[0] === shaft && one.at[3] >= start - 1e-6 && one.at[3] <= end + 1e-6);
      for (let n = 0; n < AROUND; n++) {
        const a = 2 * Math.PI * n / AROUND, b = 2 * Math.PI * (n + 1) / AROUND, c = (a + b) / 2;
        for (let k = 0; k + 1 < inside.length; k++)
          face([on(inside[k], radius, a), on(inside[k], radius, b), on(inside[k + 1], radius, b), on(inside[k + 1], radius, a)], [Math.cos(c), Math.sin(c), 0], RGB.shaft, 1, false);
        for (const [node, way] of [[inside[0], -1], [inside[inside.length - 1], 1]])
          face([on(node, 0, 0), on(node, radius, a), on(node, radius, b)], [0, 0, way], RGB.shaft, 1, false);
      }
    }
    for (const disc of solid.discs) {
      const [x, y, z, tx, ty, turned] = disc.pose.subarray(6 * frame, 6 * frame + 6), at = [...disc.centre, disc.z], rgb = RGB[disc.fill];
      const teeth = disc.teeth || 36, pitch = 2 * Math.PI / teeth, half = disc.width / 2;
      const profile = disc.teeth ? [[-0.27, disc.root], [-0.12, disc.tip], [0.12, disc.tip], [0.27, disc.root], [0.73, disc.root]] : [[-0.5, disc.tip], [0.5, disc.tip]];
      const point = (radius, angle, way) => placed(at, [x, y, z], tx, ty, radius, angle + way * disc.twist / 2, way * half);
      for (let n = 0; n < teeth; n++) {
        const zero = disc.tooth + turned + n * pitch;
        for (let k = 0; k + 1 < profile.length; k++) {
          const [[a, inner], [b, outer]] = [profile[k], profile[k + 1]].map(([share, radius]) => [zero + share * pitch, radius]);
          const rise = outer - inner, run = (b - a) * (inner + outer) / 2, c = (a + b) / 2 - Math.atan2(rise, run);
          face([point(inner, a, -1), point(outer, b, -1), point(outer, b, 1), point(inner, a, 1)], [Math.cos(c), Math.sin(c), 0], rgb, 0.96, false);
        }
        for (const way of [-1, 1]) {
          const rim = profile.map(([share, radius]) => point(radius, zero + share * pitch, way));
          face([point(disc.bore, zero + profile[0][0] * pitch, way), ...rim, point(disc.bore, zero + profile[profile.length - 1][0] * pitch, way)], [0, 0, way], rgb, 0.96, false);
        }
      }
    }
    faces.sort((one, other) => one[0] - other[0]);
    context.lineJoin = "round";
    context.lineWidth = 0.6 * ratio;
    for (const [, points, fill] of faces) {
      context.beginPath();
      for (const p of points) context.lineTo(...flat(p));
      context.closePath();
      context.fillStyle = context.strokeStyle = fill;
      context.fill();
      context.stroke();  // no light between neighbours
    }
    function line(points, stroke, wide, dash) {
      context.setLineDash(dash || []);
      context.lineWidth = wide * ratio;
      context.strokeStyle = stroke;
      context.beginPath();
      for (const p of points) context.lineTo(...flat(p));
      context.stroke();
      context.setLineDash([]);
    }
    // axes without load and bent, bearings where they stand, forces on them
    for (const shaft of new Set(nodes.map((one) => one.at[0]))) {
      const own = nodes.filter((one) => one.at[0] === shaft);
      line([own[0].at.slice(1), own[own.length - 1].at.slice(1)], color("--ink"), 0.8, [8 * ratio, 3 * ratio, 2 * ratio, 3 * ratio]);
      line(own.map((one) => on(one, 0, 0)), "#cc0000", 1.8);
    }
    for (let k = 0, n = solid.bearing.length / 4; k < n; k++) {
      const [x, y, z, radius] = solid.bearing.subarray(4 * k, 4 * k + 4), first = 3 * (n * frame + k);
      const d = solid.carried.length ? Array.from(solid.carried.subarray(first, first + 3)) : [0, 0, 0];
      for (const [r, half] of [[1.12, 0.28], [1.6, 0.28], [1.12, -0.28], [1.6, -0.28]])
        line(Array.from({ length: 41 }, (_, i) => placed([x, y, z], d, 0, 0, r * radius, i * Math.PI / 20, half * radius)), color("--accent"), 0.9);
      const force = solid.force.subarray(2 * (n * frame + k), 2 * (n * frame + k) + 2), node = nodes.find((one) => Math.hypot(one.at[1] - x, one.at[2] - y, one.at[3] - z) < 1e-6);
      const from = node ? on(node, 0, 0) : [x, y, z], long = 0.14 * solid.size / solid.most;
      arrow(flat(from), flat([from[0] + long * force[0], from[1] + long * force[1], from[2]]));
    }
    function arrow([x, y], [u, v]) {
      const length = Math.hypot(u - x, v - y), head = Math.min(9 * ratio, 0.5 * length);
      if (!(length > 2 * ratio)) return;
      const c = (u - x) / length, s = (v - y) / length;
      context.strokeStyle = context.fillStyle = color("--ink");
      context.lineWidth = 2 * ratio;
      context.beginPath(); context.moveTo(x, y); context.lineTo(u - head * c, v - head * s); context.stroke();
      context.beginPath(); context.moveTo(u, v);
      context.lineTo(u - head * (c - 0.45 * s), v - head * (s + 0.45 * c)); context.lineTo(u - head * (c + 0.45 * s), v - head * (s - 0.45 * c));
      context.closePath(); context.fill();
    }
    context.font = 12 * ratio + "px system-ui, sans-serif";
    context.textAlign = "center";
    context.fillStyle = color("--ink");
    for (const disc of solid.discs) {
      const [x, y] = flat([disc.centre[0], disc.centre[1] + disc.tip, disc.z]);
      context.lineWidth = 3 * ratio;
      context.strokeStyle = color("--card");
      context.strokeText(disc.name, x, y - 6 * ratio);
      context.fillText(disc.name, x, y - 6 * ratio);
    }
  }
  return { unpacked: unpacked, draw: draw };
})();
