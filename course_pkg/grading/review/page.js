// The review page: it shows one answer at a time, and saves points and comments.
"use strict";
const token = document.currentScript.dataset.token;
const CHECKED = 5000; // Every CHECKED ms, the page asks whether another program has changed overrides.csv.
const AHEAD = 3; // The page loads this many answers in advance.
const $ = (id) => document.getElementById(id);

let items = []; // all answers, sorted by part
let rows = {}; // the stored points and comments, by the number of the answer
let drafts = {}; // points and comments that could not be saved, by the number of the answer
let current = -1; // the number of the shown answer
let undoable = 0;
let saving = Promise.resolve(); // The page sends changes one after the other.
const loaded = new Map(); // the HTML of answers, by their number

async function request(path, data) {
  const options = { headers: { Authorization: `token ${token}` } };
  if (data) Object.assign(options, { method: "POST", body: JSON.stringify(data) });
  let response;
  try {
    response = await fetch(path, options);
  } catch {
    throw new Error("The review has ended. Type `course review` again, and keep this page open.");
  }
  const isJson = response.headers.get("Content-Type") === "application/json";
  const answer = isJson ? await response.json() : await response.text();
  if (!response.ok) throw new Error((isJson && answer.problem) || `${response.status} ${response.statusText}`);
  return answer;
}

function html(number) {
  if (!loaded.has(number)) {
    const pending = request(`items/${number}`);
    // If the user returns to this answer, the page sends a new request.
    pending.catch(() => loaded.delete(number));
    loaded.set(number, pending);
  }
  return loaded.get(number);
}

async function show(number) {
  if (number < 0 || number >= items.length) return announce(number < 0 ? "This is the first answer." : "This is the last answer.");
  commit();
  const part = current >= 0 ? items[current].part : "";
  current = number;
  if (items[number].part !== part) listStudents();
  $("part").value = items[number].part;
  $("students").value = String(number);
  $("progress").textContent = progress();
  fill();
  try {
    const text = await html(number);
    if (number !== current) return;
    $("answer").innerHTML = text; // The server has escaped all texts in this HTML.
    const alike = Number($("alike").dataset.count);
    $("identical").hidden = !alike;
    $("identical").textContent = `Apply to ${alike} identical ${alike === 1 ? "answer" : "answers"}, too`;
  } catch (error) {
    complain(error.message);
  }
  scrollTo(0, 0);
  document.body.dataset.shown = String(number);
  for (let next = number - 1; next <= number + AHEAD; next++) if (next >= 0 && next < items.length) html(next).catch(() => {});
}

function stored(number) {
  const row = rows[number];
  return { points: row && row.points !== null ? String(row.points) : "", comment: row ? row.comment : "" };
}

function fill() {
  const item = items[current];
  const shown = drafts[current] || stored(current);
  $("points").value = shown.points;
  $("points").placeholder = String(item.points);
  $("comment").value = shown.comment;
  $("possible").textContent = String(item.possible);
  $("computed").textContent = `The check gave ${item.points} of ${item.possible} points. If this field is empty, the student keeps these points.`;
  $("outdated").hidden = !(rows[current] && rows[current].outdated);
  $("remove").disabled = !rows[current];
  $("undo").disabled = !undoable;
  complain(drafts[current] ? drafts[current].problem : "");
}

function label(number) {
  const item = items[number];
  const row = rows[number];
  const points = row && row.points !== null ? row.points : item.points;
  const unsaved = drafts[number] ? " not saved" : "";
  return `${row ? "✎ " : ""}${item.name}: ${points}/${item.possible}${item.flagged ? " ⚑" : ""}${unsaved}`;
}

function listStudents() {
  const same = items.map((item, number) => [item, number]).filter(([item]) => item.part === items[current].part);
  $("students").replaceChildren(...same.map(([, number]) => new Option(label(number), String(number))));
}

function progress() {
  const numbers = [...$("students").options].map((option) => Number(option.value));
  const reviewed = numbers.filter((number) => rows[number]).length;
  return `${items[current].name}: ${numbers.indexOf(current) + 1} of ${numbers.length}; ${reviewed} reviewed`;
}

function refresh() {
  for (const option of $("students").options) option.textContent = label(Number(option.value));
  $("progress").textContent = progress();
}

function announce(text) {
  $("status").textContent = text;
}

function complain(text) {
  $("problem").hidden = !text;
  $("problem").firstElementChild.textContent = text;
}

// Save what the user typed, if it differs from the stored values.
function commit() {
  if (current < 0) return;
  const typed = { points: $("points").value.trim(), comment: $("comment").value.trim() };
  const known = drafts[current] || stored(current);
  if (typed.points.replace(",", ".") !== known.points || typed.comment !== known.comment) save(current, typed);
}

function save(number, typed, identical = false) {
  drafts[number] = { ...typed, problem: "" };
  saving = saving.then(async () => {
    try {
      const answer = await request("save", { number, ...typed, identical });
      if (drafts[number] && drafts[number].points === typed.points && drafts[number].comment === typed.comment) delete drafts[number];
      undoable = answer.undo;
      const others = answer.count - 1;
      const name = `${items[number].name}, ${items[number].part}`;
      adopt(answer, others ? `Saved: ${name}, and ${others} identical ${others === 1 ? "answer" : "answers"}` : `Saved: ${name}`);
    } catch (error) {
      drafts[number] = { ...typed, identical, problem: `Not saved: ${error.message}` };
      announce("");
      if (number === current) complain(drafts[number].problem);
    }
    refresh();
  });
  return saving;
}

// Use the rows that the server has sent.
function adopt(answer, text) {
  rows = answer.reloaded ? {} : rows;
  for (const [number, row] of Object.entries(answer.rows || {})) {
    if (row) rows[number] = row;
    else delete rows[number];
  }
  announce(answer.reloaded ? `${text}${text ? ". " : ""}Another program has changed overrides.csv, so this page has read the file again.` : text);
  refresh();
  const typing = document.activeElement === $("points") || document.activeElement === $("comment");
  if (!typing || text) {
    if (!typing) fill();
    else {
      $("remove").disabled = !rows[current];
      $("undo").disabled = !undoable;
      $("outdated").hidden = !(rows[current] && rows[current].outdated);
      complain(drafts[current] ? drafts[current].problem : "");
    }
  }
}

function undo() {
  commit();
  const number = current;
  saving = saving.then(async () => {
    try {
      const answer = await request("undo", {});
      undoable = answer.undo;
      adopt(answer, "Undone");
      if (number !== current) return; // The user has moved to another answer.
      if (typeof answer.shown === "number" && answer.shown !== current) await show(answer.shown);
      else fill();
    } catch (error) {
      complain(`The change was not undone: ${error.message}`);
    }
  });
}

function remove() {
  $("points").value = "";
  $("comment").value = "";
  commit();
}

function setPoints(value) {
  $("points").value = String(value);
  commit();
}

function applyToIdentical() {
  if ($("identical").hidden) return announce("No other answer is identical.");
  save(current, { points: $("points").value.trim(), comment: $("comment").value.trim() }, true);
}

function retry() {
  for (const [number, draft] of Object.entries(drafts)) {
    const typed = Number(number) === current ? { points: $("points").value.trim(), comment: $("comment").value.trim() } : draft;
    save(Number(number), { points: typed.points, comment: typed.comment }, draft.identical);
  }
}

function showPart(step) {
  const parts = [...new Set(items.map((item) => item.part))];
  const wanted = parts[parts.indexOf(items[current].part) + step];
  if (wanted === undefined) return announce(step > 0 ? "This is the last part." : "This is the first part.");
  show(items.findIndex((item) => item.part === wanted));
}

function focusOn(id) {
  $(id).focus();
  if (id === "points") $(id).select();
}

const KEYS = {
  n: () => show(current + 1), j: () => show(current + 1),
  p: () => show(current - 1), k: () => show(current - 1),
  N: () => showPart(1), P: () => showPart(-1),
  g: () => focusOn("points"), c: () => focusOn("comment"),
  f: () => setPoints(items[current].possible),
  s: () => setPoints($("points").value || items[current].points),
  a: applyToIdentical, x: remove, u: undo, r: retry,
};

document.addEventListener("keydown", (event) => {
  const field = document.activeElement;
  if (event.key === "Escape" || (field.id === "comment" && event.key === "Enter" && event.ctrlKey)) {
    commit();
    $("answer").focus();
    return;
  }
  if (event.ctrlKey || event.altKey || event.metaKey || event.isComposing || field.id === "comment" || current < 0) return;
  if (field.id === "points" && event.key === "Enter") return commit();
  if (field.id !== "points" && /^[0-9]$/.test(event.key)) {
    focusOn("points"); // The digit replaces the selected text.
    return;
  }
  if (KEYS[event.key]) {
    event.preventDefault(); // Without this call, a list that has the focus would search for the letter.
    KEYS[event.key]();
    if (field.id === "points" && "njpkNP".includes(event.key)) focusOn("points");
  }
});
for (const id of ["points", "comment"]) $(id).addEventListener("change", commit);
$("students").addEventListener("change", (event) => show(Number(event.target.value)));
$("part").addEventListener("change", (event) => show(items.findIndex((item) => item.part === event.target.value)));
$("save").addEventListener("click", () => save(current, { points: $("points").value.trim(), comment: $("comment").value.trim() }));
for (const [id, action] of Object.entries({ identical: applyToIdentical, remove, undo, retry })) $(id).addEventListener("click", action);
addEventListener("beforeunload", (event) => {
  if (Object.keys(drafts).length) event.preventDefault();
});

// Read the rows again if another program has changed the file.
async function look() {
  if (document.hidden || Object.keys(drafts).length) return;
  try {
    const answer = await request("rows");
    complain("");
    if (answer.reloaded) adopt(answer, "");
  } catch (error) {
    complain(error.message);
  }
}
setInterval(look, CHECKED);
addEventListener("focus", look);

(async () => {
  try {
    const all = await request("items");
    items = all.items;
    rows = all.rows;
    undoable = all.undo;
    $("part").replaceChildren(...[...new Set(items.map((item) => item.part))].map((part) => new Option(part, part)));
    await show(0);
    $("answer").focus({ preventScroll: true });
  } catch (error) {
    complain(error.message);
  }
})();
