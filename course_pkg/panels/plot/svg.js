/* Drawing in SVG: elements, the looks of series, and redrawing when the width changes. */

const SPACE = "http://www.w3.org/2000/svg";
const DASHES = ["", "7 4", "2 3", "10 3 2 3", "14 4", "5 2 1 2 1 2"];
const R = 4; // px, half a marker's size
/** A marker's outline around 0, 0; no two look alike without colour. */
const MARKERS = [
  `M${-R} 0A${R} ${R} 0 1 1 ${R} 0A${R} ${R} 0 1 1 ${-R} 0Z`,
  `M${-R} ${-R}H${R}V${R}H${-R}Z`,
  `M0 ${-R - 1}L${R + 1} ${R}H${-R - 1}Z`,
  `M0 ${-R - 2}L${R + 1} 0L0 ${R + 2}L${-R - 1} 0Z`,
  `M0 ${R + 1}L${R + 1} ${-R}H${-R - 1}Z`,
  `M${-R} -1.5H-1.5V${-R}H1.5V-1.5H${R}V1.5H1.5V${R}H-1.5V1.5H${-R}Z`,
];

/** How series number `index` looks: every seventh looks like the first. @param {number} index */
export function look(index) {
  return { dash: DASHES[index % DASHES.length], marker: MARKERS[index % MARKERS.length], name: `ros-series ros-series-${index % DASHES.length}` };
}

/** Make an element of SVG; `text` is its text. @param {string} tag @param {Record<string, any>} [props] @param {...Node} children
 * @returns {SVGElement} */
export function s(tag, props = {}, ...children) {
  const element = /** @type {SVGElement} */ (document.createElementNS(SPACE, tag));
  for (const [key, value] of Object.entries(props)) {
    if (key === "text") element.textContent = value;
    else if (value !== "" && value !== null) element.setAttribute(key, String(value));
  }
  element.append(...children);
  return element;
}

/** One path with a marker at each place, which draws faster than as many elements.
 * @param {[number, number][]} places @param {number} index of the series
 * @param {boolean} [crowded] whether they lie over one another */
export function markers(places, index, crowded = false) {
  const { marker, name } = look(index);
  return s("g", { class: `${name} ros-marker${crowded ? " ros-crowded" : ""}` }, s("path", { d: places.map(([x, y]) => moved(marker, x, y)).join("") }));
}

/** @param {string} outline of absolute M, L, H, V, A and Z @param {number} x @param {number} y */
function moved(outline, x, y) {
  return outline.replace(/([MLHVA])([^MLHVAZ]*)/g, (_, letter, numbers) => {
    const given = numbers.trim().split(/[ ,]+/).map(Number);
    if (letter === "H") return `H${near(given[0] + x)}`;
    if (letter === "V") return `V${near(given[0] + y)}`;
    const kept = given.slice(0, -2).map((/** @type {number} */ each) => `${each} `).join("");
    return `${letter}${kept}${near(given.at(-2) + x)} ${near(given.at(-1) + y)}`;
  });
}

/** A place on the page, to a tenth of a pixel. @param {number} value */
export function near(value) {
  return Math.round(value * 10) / 10;
}

/** Call `draw(width)` now and whenever the element's width changes; returns what ends that.
 * @param {Element} element @param {(width: number) => void} draw */
export function whenWide(element, draw) {
  let before = 0;
  const observer = new ResizeObserver(() => {
    const width = Math.floor(element.clientWidth);
    if (width && width !== before) draw(before = width);
  });
  observer.observe(element);
  return () => observer.disconnect();
}
