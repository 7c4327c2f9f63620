/* Axes: which values stand at which ticks, and how numbers are written. Pure functions of numbers. */
import { power } from "./kit.js";

/** @typedef {{low: number, high: number, ticks: {value: number, text: string}[]}} Axis */

/** A value to about a thousandth of its axis. @param {Axis} axis @param {number} value */
export function reading({ low, high }, value) {
  const decimals = Math.min(100, Math.max(0, 3 - Math.floor(Math.log10(high - low))));
  return decimals > 6 || high - low >= 1e9 ? power(value, 4) : String(Number(value.toFixed(decimals)));
}

/**
 * An axis for values from `low` to `high` with at most `most` steps. A `snug` one ends where the values end; another is
 * widened to its marks, and begins at 0 where that is not far off, so that heights can be compared.
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
  const round = (/** @type {number} */ value) => Math.round(value * 1e6) / 1e6; // 0.3 / 0.1 is not quite 3
  const [first, last] = snug ? [Math.ceil(round(from / step)), Math.floor(round(to / step))] : [Math.floor(round(from / step)), Math.ceil(round(to / step))];
  const ticks = Array.from({ length: last - first + 1 }, (_, index) => (first + index) * step);
  return { low: snug ? from : first * step, high: snug ? to : last * step, ticks: ticks.map((value) => ({ value, text: tickText(value, step, ticks) })) };
}

/** Where a value stands on an axis, from 0 to 1. @param {Axis} axis @param {number} value */
export function place({ low, high }, value) {
  return (value - low) / (high - low);
}

/** The smallest of 1, 2 and 5 times a power of ten that makes at most `most` steps. @param {number} range @param {number} most */
function niceStep(range, most) {
  const ten = 10 ** Math.floor(Math.log10(range / most));
  return /** @type {number} */ ([1, 2, 5, 10].map((factor) => factor * ten).find((step) => range / step <= most * 1.000001));
}

/** A tick's text: all ticks of an axis with equally many decimals. @param {number} value @param {number} step @param {number[]} all */
function tickText(value, step, all) {
  const largest = Math.max(...all.map(Math.abs));
  if (Math.abs(value) < step / 2) return "0";
  if (step >= 1e5 || largest < 1e-3) return power(value, Math.max(0, Math.ceil(Math.log10(Math.abs(value) / step) - 1e-9)));
  return value.toFixed(Math.max(0, -Math.floor(Math.log10(step) + 1e-9)));
}
