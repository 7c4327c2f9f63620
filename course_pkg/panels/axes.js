/* The axes of a chart: their limits, their ticks, and the texts of their numbers. */
import { power } from "./kit.js";

/** @typedef {{low: number, high: number, ticks: {value: number, text: string}[]}} Axis */

/** Returns a value as text, rounded to about a thousandth of its axis. @param {Axis} axis @param {number} value */
export function reading({ low, high }, value) {
  const decimals = Math.min(100, Math.max(0, 3 - Math.floor(Math.log10(high - low))));
  return decimals > 6 || high - low >= 1e9 ? power(value, 4) : String(Number(value.toFixed(decimals)));
}

/** Returns an axis for a range of values; `most` is the maximum number of steps. If `snug` is true, the axis
 * ends exactly at the ends of the range. Otherwise, the axis is extended to the next ticks, and begins at 0
 * if 0 is near enough, so that a reader can compare heights.
 * @param {number} low @param {number} high @param {number} most @param {boolean} [snug] @returns {Axis}
 */
export function axis(low, high, most, snug = false) {
  let [from, to] = [low, high];
  if (!snug && from > 0 && from < 0.5 * to) from = 0;
  if (!snug && to < 0 && to > 0.5 * from) to = 0;
  if (from === to) {
    const room = snug ? 0.5 : Math.abs(from) * 0.1 || 1;
    [from, to] = [from - room, to + room];
  }
  const step = niceStep(to - from, most);
  // In JavaScript, 0.3 / 0.1 gives 2.9999999999999996 instead of 3.
  const round = (/** @type {number} */ value) => Math.round(value * 1e6) / 1e6;
  const [first, last] = snug ? [Math.ceil(round(from / step)), Math.floor(round(to / step))] : [Math.floor(round(from / step)), Math.ceil(round(to / step))];
  const ticks = Array.from({ length: last - first + 1 }, (_, index) => (first + index) * step);
  return { low: snug ? from : first * step, high: snug ? to : last * step, ticks: ticks.map((value) => ({ value, text: tickText(value, step, ticks) })) };
}

/** Returns the position of a value on an axis, from 0 to 1. @param {Axis} axis @param {number} value */
export function place({ low, high }, value) {
  return (value - low) / (high - low);
}

/** Returns the smallest step (1, 2 or 5 times a power of ten) that divides the range into at most `most`
 * steps.
 * @param {number} range @param {number} most */
function niceStep(range, most) {
  const ten = 10 ** Math.floor(Math.log10(range / most));
  return /** @type {number} */ ([1, 2, 5, 10].map((factor) => factor * ten).find((step) => range / step <= most * 1.000001));
}

/** Returns the text of a tick. All ticks of an axis have the same number of decimals.
 * @param {number} value @param {number} step @param {number[]} all */
function tickText(value, step, all) {
  const largest = Math.max(...all.map(Math.abs));
  if (Math.abs(value) < step / 2) return "0";
  if (step >= 1e5 || largest < 1e-3) return power(value, Math.max(0, Math.ceil(Math.log10(Math.abs(value) / step) - 1e-9)));
  return value.toFixed(Math.max(0, -Math.floor(Math.log10(step) + 1e-9)));
}
