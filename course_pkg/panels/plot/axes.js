/* Axes: which values stand at which marks, and how numbers are written. Pure functions of numbers. */

/** @typedef {{low: number, high: number, log: boolean, ticks: {value: number, text: string}[]}} Axis */

/** A number as one reads it aloud: up to `digits` significant digits, no exponent between 0.0001 and a million.
 * @param {number} value @param {number} [digits] @returns {string} */
export function numeral(value, digits = 4) {
  const size = Math.abs(value);
  if (size !== 0 && (size < 1e-4 || size >= 1e6)) return power(value, digits - 1);
  return String(size >= 10 ** digits ? Math.round(value) : Number(value.toPrecision(digits)));
}

/** A value to about a thousandth of its axis. @param {Axis} axis @param {number} value */
export function reading({ low, high, log }, value) {
  if (log) return numeral(value);
  const decimals = Math.min(100, Math.max(0, 3 - Math.floor(Math.log10(high - low))));
  return decimals > 6 || high - low >= 1e9 ? power(value, 4) : String(Number(value.toFixed(decimals)));
}

/** 2.5e-7. @param {number} value @param {number} decimals */
function power(value, decimals) {
  return value === 0 ? "0" : value.toExponential(decimals).replace(/\.?0*e\+?/, "e");
}

/**
 * An axis for values from `low` to `high` with at most `most` steps. A `snug` one ends where the values end; another is
 * widened to its marks, and begins at 0 where that is not far off, so that heights can be compared.
 * @param {number} low @param {number} high @param {number} most @param {{log?: boolean, snug?: boolean, zero?: boolean}} options
 * @returns {Axis}
 */
export function axis(low, high, most, { log = false, snug = false, zero = false } = {}) {
  if (log) return logarithmic(low, high, most);
  let [from, to] = [low, high];
  if (zero || (!snug && from > 0 && from < 0.5 * to)) from = Math.min(from, 0);
  if (zero || (!snug && to < 0 && to > 0.5 * from)) to = Math.max(to, 0);
  if (from === to) {
    const room = snug ? 0.5 : Math.abs(from) * 0.1 || 1;
    [from, to] = [from - room, to + room];
  }
  const step = niceStep(to - from, most);
  const round = (/** @type {number} */ value) => Math.round(value * 1e6) / 1e6; // 0.3 / 0.1 is not quite 3
  const [first, last] = snug ? [Math.ceil(round(from / step)), Math.floor(round(to / step))] : [Math.floor(round(from / step)), Math.ceil(round(to / step))];
  const ticks = Array.from({ length: last - first + 1 }, (_, index) => (first + index) * step);
  return { low: snug ? from : first * step, high: snug ? to : last * step, log, ticks: ticks.map((value) => ({ value, text: mark(value, step, ticks) })) };
}

/** Where a value stands on an axis, from 0 to 1. @param {Axis} axis @param {number} value */
export function place({ low, high, log }, value) {
  return log ? Math.log(value / low) / Math.log(high / low) : (value - low) / (high - low);
}

/** The smallest of 1, 2 and 5 times a power of ten that makes at most `most` steps. @param {number} range @param {number} most */
function niceStep(range, most) {
  const power = 10 ** Math.floor(Math.log10(range / most));
  return /** @type {number} */ ([1, 2, 5, 10].map((factor) => factor * power).find((step) => range / step <= most * 1.000001));
}

/** A mark's text: all marks of an axis with equally many decimals. @param {number} value @param {number} step @param {number[]} all */
function mark(value, step, all) {
  const largest = Math.max(...all.map(Math.abs));
  if (Math.abs(value) < step / 2) return "0";
  if (step >= 1e5 || largest < 1e-3) return power(value, Math.max(0, Math.ceil(Math.log10(Math.abs(value) / step) - 1e-9)));
  return value.toFixed(Math.max(0, -Math.floor(Math.log10(step) + 1e-9)));
}

/** The finest marks of which there are not too many: at every digit, at 1, 2 and 5, at 1, or at every so manieth power of ten.
 * @param {number} low @param {number} high @param {number} most @returns {Axis} */
function logarithmic(low, high, most) {
  let [from, to] = [step(low, Math.floor), step(high, Math.ceil)];
  if (from === to) [from, to] = [step(low / 2, Math.floor), step(high * 2, Math.ceil)];
  const powers = Array.from({ length: Math.ceil(Math.log10(to / from)) + 2 }, (_, index) => index + Math.floor(Math.log10(from) + 1e-9));
  const choices = [[1, 2, 3, 4, 5, 6, 7, 8, 9], [1, 2, 5], [1, 3], [1]].map((digits) => powers.flatMap((each) => digits.map((digit) => exact(digit, each))))
    .map((values) => values.filter((value) => value >= from * (1 - 1e-9) && value <= to * (1 + 1e-9)));
  const tens = /** @type {number[]} */ (choices.at(-1));
  const every = Math.ceil(tens.length / most);
  const values = choices.find((each) => each.length <= most + 2) ?? tens.filter((_, index) => index % every === 0);
  return { low: from, high: to, log: true, ticks: values.map((value) => ({ value, text: numeral(value) })) };
}

/** A value rounded to one digit. @param {number} value @param {(digit: number) => number} round */
function step(value, round) {
  const ten = Math.floor(Math.log10(value) + 1e-9);
  return exact(round(Number((value / 10 ** ten).toPrecision(12))), ten);
}

/** @param {number} digit @param {number} ten */
function exact(digit, ten) {
  return Number(`${digit}e${ten}`); // 3 * 10 ** -5 is not quite 3e-5
}
