// Outlines that parts of the page draw alike, as paths of SVG.

export const circle = (r) => "M" + r + " 0A" + r + " " + r + " 0 1 0 " + -r + " 0A" + r + " " + r + " 0 1 0 " + r + " 0Z";

// the outline of a gear: its tooth, turned about the axis; numbers with so many digits
export const toothed = (body, digits) => {
  const tooth = [...body.tooth], { teeth, pitch } = body; // plain numbers: Vue watches what is read of others
  let text = "";
  for (let n = 0; n < teeth; n++) {
    const c = Math.cos(n * pitch), s = Math.sin(n * pitch);
    for (let k = 0; k < tooth.length; k += 2) text += (text ? "L" : "M") + (c * tooth[k] - s * tooth[k + 1]).toFixed(digits) + " " + (s * tooth[k] + c * tooth[k + 1]).toFixed(digits);
  }
  return text + "Z";
};
