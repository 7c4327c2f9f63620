/* The drawing of a turtle. */
import { SIDE, pixel } from "./recording.js";

/** Draws a turtle and its name, seen from above.
 * @param {CanvasRenderingContext2D} pen @param {import("./recording.js").Place} place @param {string} body
 * @param {string} name @param {boolean} dark */
export function drawTurtle(pen, place, body, name, dark) {
  const [x, y] = pixel(place.x, place.y);
  pen.save();
  pen.translate(x, y);
  pen.save();
  pen.rotate(-place.theta / 1000);
  pen.lineWidth = 1.5;
  pen.strokeStyle = "#ffffff";
  pen.fillStyle = "#9ccc65";
  for (const [px, py, rx, ry] of [[19, 0, 7, 5], [11, 13, 6, 4], [11, -13, 6, 4], [-11, 13, 6, 4], [-11, -13, 6, 4], [-19, 0, 5, 2]]) oval(pen, px, py, rx, ry);
  pen.fillStyle = body;
  oval(pen, 0, 0, 16, 13);
  pen.strokeStyle = "rgb(255 255 255 / 45%)";
  pen.beginPath();
  pen.moveTo(-9, 0); pen.lineTo(9, 0); pen.moveTo(-4, -10); pen.lineTo(-4, 10); pen.moveTo(5, -10); pen.lineTo(5, 10);
  pen.stroke();
  pen.restore();
  pen.font = "12px ui-monospace, Menlo, Consolas, monospace";
  pen.textAlign = "center";
  pen.lineWidth = 3;
  pen.strokeStyle = dark ? "#ffffff" : "#10182b";
  pen.fillStyle = dark ? "#10182b" : "#ffffff";
  const reach = pen.measureText(name).width / 2 + 4;
  const at = /** @type {[string, number, number]} */ ([name, Math.min(Math.max(x, reach), SIDE - reach) - x, y > SIDE - 40 ? -26 : 36]);
  pen.strokeText(...at);
  pen.fillText(...at);
  pen.restore();
}

/** @param {CanvasRenderingContext2D} pen @param {number} x @param {number} y @param {number} rx @param {number} ry */
function oval(pen, x, y, rx, ry) {
  pen.beginPath();
  pen.ellipse(x, y, rx, ry, 0, 0, 2 * Math.PI);
  pen.fill();
  pen.stroke();
}
