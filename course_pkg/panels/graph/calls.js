/* The lines of calls, from the caller to the service. This code draws the lines; graphviz does not draw
   them. */

const SVG = "http://www.w3.org/2000/svg";
// Each bend is a fraction of the length of the line; the code uses the bend that crosses the fewest shapes.
const BENDS = [0.15, -0.15, 0.3, -0.3, 0.5, -0.5];
const SAMPLES = 16;

/** @typedef {{x: number, y: number}} Point */
/** @typedef {Point & {wide: number, high: number}} Place the centre, and half of the width and height */

/** Returns the position and size of a shape in the drawing. @param {Element} shape @returns {Place} */
export function place(shape) {
  const outline = /** @type {SVGGraphicsElement} */ (shape.querySelector("ellipse, rect:last-of-type, polygon"));
  const { x, y, width, height } = outline.getBBox();
  return { x: x + width / 2, y: y + height / 2, wide: width / 2, high: height / 2 };
}

/** @param {Place} from @param {Place} to @param {Place[]} others the shapes that the line should not cross
 * @param {number} age in s @param {boolean} waits */
export function callLine(from, to, others, age, waits) {
  const ways = BENDS.map((bend) => way(from, to, bend));
  const hits = ways.map((each) => others.filter((other) => crosses(each, other)).length);
  const { start, top, end } = ways[hits.indexOf(Math.min(...hits))];
  const angle = Math.atan2(end.y - top.y, end.x - top.x) + Math.PI;
  const sides = [angle - 0.45, angle + 0.45].map((side) => `${end.x + 9 * Math.cos(side)},${end.y + 9 * Math.sin(side)}`);
  const line = document.createElementNS(SVG, "g");
  line.setAttribute("class", waits ? "ros-asked ros-waits" : "ros-asked");
  if (!waits) line.style.animationDelay = `${-age}s`;
  for (const [tag, name, value] of [["path", "d", `M${start.x},${start.y} Q${top.x},${top.y} ${end.x},${end.y}`],
    ["polygon", "points", `${end.x},${end.y} ${sides.join(" ")}`]]) {
    line.append(document.createElementNS(SVG, tag));
    line.lastElementChild?.setAttribute(name, value);
  }
  return line;
}

/** Returns a curve from the border of one shape to the border of the other shape.
 * @param {Place} from @param {Place} to @param {number} bend */
function way(from, to, bend) {
  const top = { x: (from.x + to.x) / 2 - bend * (to.y - from.y), y: (from.y + to.y) / 2 + bend * (to.x - from.x) };
  return { start: border(from, top), top, end: border(to, top) };
}

/** Returns the point where a shape's border crosses the line from the shape's centre to another point.
 * @param {Place} shape @param {Point} point @returns {Point} */
function border(shape, point) {
  const [dx, dy] = [point.x - shape.x, point.y - shape.y];
  const part = Math.min(1, 1 / Math.max(Math.abs(dx) / shape.wide, Math.abs(dy) / shape.high, 1e-6));
  return { x: shape.x + part * dx, y: shape.y + part * dy };
}

/** @param {{start: Point, top: Point, end: Point}} curve @param {Place} shape */
function crosses({ start, top, end }, shape) {
  for (let step = 1; step < SAMPLES; step += 1) {
    const t = step / SAMPLES;
    const [one, two, three] = [(1 - t) ** 2, 2 * t * (1 - t), t ** 2];
    const x = one * start.x + two * top.x + three * end.x;
    const y = one * start.y + two * top.y + three * end.y;
    if (Math.abs(x - shape.x) < shape.wide && Math.abs(y - shape.y) < shape.high) return true;
  }
  return false;
}
