/* The small shapes of a timeline. Each function draws one shape at a position (px). */

/** @param {CanvasRenderingContext2D} pen @param {number} x1 @param {number} y1 @param {number} x2 @param {number} y2 */
export function head(pen, x1, y1, x2, y2) {
  const angle = Math.atan2(y2 - y1, x2 - x1);
  pen.beginPath();
  pen.moveTo(x2, y2);
  for (const turn of [2.72, -2.72]) pen.lineTo(x2 + 7 * Math.cos(angle + turn), y2 + 7 * Math.sin(angle + turn));
  pen.fill();
}

/** Draws a bar with a jagged right end, which means that the event had not ended.
 * @param {CanvasRenderingContext2D} pen @param {number} x @param {number} y @param {number} wide @param {number} high
 */
export function torn(pen, x, y, wide, high) {
  const teeth = Math.max(2, Math.round(high / 6));
  pen.moveTo(x, y);
  pen.lineTo(x + wide, y);
  for (let tooth = 0; tooth < teeth; tooth++) {
    pen.lineTo(x + wide - 6, y + ((tooth + 0.5) * high) / teeth);
    pen.lineTo(x + wide, y + ((tooth + 1) * high) / teeth);
  }
  pen.lineTo(x, y + high);
  pen.closePath();
}

/** @param {CanvasRenderingContext2D} pen @param {number} x @param {number} y @param {number} high @param {string} colour @param {boolean} [dot] */
export function tick(pen, x, y, high, colour, dot = false) {
  pen.fillStyle = colour;
  pen.fillRect(x - 1, y, 2, high);
  if (!dot) return;
  pen.beginPath();
  pen.arc(x, y + 2.5, 2.5, 0, 7);
  pen.fill();
}

/** @param {CanvasRenderingContext2D} pen @param {number} x @param {number} y @param {string} colour */
export function cross(pen, x, y, colour) {
  pen.strokeStyle = colour;
  pen.lineWidth = 2.5;
  pen.beginPath();
  pen.moveTo(x - 4, y - 4);
  pen.lineTo(x + 4, y + 4);
  pen.moveTo(x - 4, y + 4);
  pen.lineTo(x + 4, y - 4);
  pen.stroke();
}

/** @param {CanvasRenderingContext2D} pen @param {number} x @param {number} y @param {string} edge @param {string} ground */
export function diamond(pen, x, y, edge, ground) {
  pen.beginPath();
  for (const [dx, dy] of [[0, -4], [4, 0], [0, 4], [-4, 0]]) pen.lineTo(x + dx, y + dy);
  pen.closePath();
  outlined(pen, edge, ground);
}

/** @param {CanvasRenderingContext2D} pen @param {number} x @param {number} y @param {string} edge @param {string} ground */
export function ring(pen, x, y, edge, ground) {
  pen.beginPath();
  pen.arc(x, y, 3.5, 0, 7);
  outlined(pen, edge, ground);
}

/** @param {CanvasRenderingContext2D} pen @param {string} edge @param {string} ground */
function outlined(pen, edge, ground) {
  pen.fillStyle = ground;
  pen.fill();
  pen.strokeStyle = edge;
  pen.lineWidth = 1.5;
  pen.stroke();
}
