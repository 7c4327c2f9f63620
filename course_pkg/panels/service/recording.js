/* Finds a recorded response. Requests with equal values are equal, even if the reader typed the values differently. */

/** @param {{draft: any}[]} recording @param {import("../forms/fields.js").Field[]} fields @param {any} draft @returns {any} */
export function recorded(recording, fields, draft) {
  return recording.find((each) => fields.every((field) => equal(field, each.draft[field.name], draft[field.name])));
}

/** @param {import("../forms/fields.js").Field} field @param {any} one @param {any} other @returns {boolean} */
function equal(field, one, other) {
  if (field.kind === "array" && Array.isArray(one) && Array.isArray(other)) {
    const item = /** @type {import("../forms/fields.js").Field} */ (field.item);
    return one.length === other.length && one.every((/** @type {any} */ each, /** @type {number} */ index) => equal(item, each, other[index]));
  }
  if (field.kind === "message") return (field.fields ?? []).every((inner) => equal(inner, one[inner.name], other[inner.name]));
  return sameText(field, one, other);
}

/** @param {import("../forms/fields.js").Field} field @param {string} one @param {string} other @returns {boolean} */
function sameText(field, one, other) {
  if (field.kind === "integer") return sameInteger(one, other);
  if (field.kind === "float" && other.trim() !== "") return rounded(field, one) === rounded(field, other);
  return one === other;
}

/** @param {string} one @param {string} other @returns {boolean} */
function sameInteger(one, other) {
  try {
    return BigInt(one) === BigInt(other);
  } catch {
    return false;
  }
}

/** @param {import("../forms/fields.js").Field} field @param {string} text @returns {number} */
function rounded(field, text) {
  return field.type.startsWith("float32") ? Math.fround(Number(text)) : Number(text);
}
