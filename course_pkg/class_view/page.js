// The class view: this script repeatedly asks the service for changes, and shows them.
"use strict";

const SHOWN = 10; // Each list shows at most this many entries.
const AGAIN = 1000; // After a failed request, the page waits this many ms.
const TICK = 10_000; // The times on the page are updated every TICK ms.
const find = (id) => document.getElementById(id);
const chapter = find("chapter");
const recent = find("recent");
const hide = find("hide");

// These variables contain the data that the service has sent. A cell is { student, part, tries, passed,
// stuck, last }, with times in s.
let epoch = "";
let version = -1;
let offset = 0; // the service's clock minus this computer's clock, in s
let students = []; // Each entry is [username, name, number].
let cells = new Map();
let hints = new Map();
let fields = new Map(); // This map finds the table field of a cell by the cell's key.
let layout = ""; // the students and parts that the table shows

const keyOf = (student, part) => `${part} ${student}`;
const now = () => Date.now() / 1000 + offset;
const triesOf = (cell) => (cell.tries === 1 ? "1 try" : `${cell.tries} tries`);
const hidden = () => hide.getAttribute("aria-pressed") === "true";
const inChapter = (part) => !chapter.value || part.startsWith(`${chapter.value}.`);
const parts = () => [...chapter.options].filter((each) => each.value && (!chapter.value || each.selected))
  .flatMap((each) => each.dataset.parts.split(" "));

function element(tag, text, kind) {
  const made = document.createElement(tag);
  made.textContent = text;
  if (kind) made.className = kind;
  return made;
}

function duration(seconds) {
  const minutes = Math.max(0, Math.floor(seconds / 60));
  if (minutes < 1) return "< 1 min";
  if (minutes < 60) return `${minutes} min`;
  if (minutes < 48 * 60) return `${Math.floor(minutes / 60)} h ${minutes % 60} min`;
  return `${Math.floor(minutes / 1440)} days`;
}

function nameOf([, name, number]) {
  return hidden() ? `Student ${number}` : name;
}

function fill(field, cell) {
  const passed = cell?.passed > 0;
  const open = cell && !passed && cell.stuck > 0;
  const words = passed ? "passed" : open ? "not yet" : cell ? "no answer yet" : "";
  const shown = passed ? "✓" : open ? `✗ ${cell.tries}` : cell ? "·" : "";
  field.className = passed ? "passed" : open ? "open" : "";
  const mark = element("span", shown);
  mark.setAttribute("aria-hidden", "true");
  field.replaceChildren(mark, element("span", open ? `${words}, ${triesOf(cell)}` : words, "unseen"));
}

function drawTable() {
  const columns = parts();
  const order = [...students].sort((one, other) =>
    hidden() ? one[2] - other[2] : one[1].localeCompare(other[1]) || one[0].localeCompare(other[0]));
  const wanted = JSON.stringify([order, columns, hidden()]);
  if (wanted === layout) return;
  layout = wanted;
  fields = new Map();
  const head = document.createElement("tr");
  for (const text of ["Student", "Passed", ...columns]) {
    const field = element("th", text);
    field.scope = "col";
    head.append(field);
  }
  document.querySelector("thead").replaceChildren(head);
  document.querySelector("tbody").replaceChildren(...order.map((student) => {
    const row = document.createElement("tr");
    const name = element("th", nameOf(student));
    name.scope = "row";
    const sum = element("td", "");
    fields.set(keyOf(student[0], "sum"), sum);
    row.append(name, sum, ...columns.map((part) => {
      const field = document.createElement("td");
      const key = keyOf(student[0], part);
      fill(field, cells.get(key));
      fields.set(key, field);
      return field;
    }));
    return row;
  }));
  for (const student of students) drawSum(student[0], columns);
}

function drawSum(student, columns) {
  const field = fields.get(keyOf(student, "sum"));
  const passed = columns.filter((part) => cells.get(keyOf(student, part))?.passed > 0).length;
  if (field) field.textContent = `${passed} of ${columns.length}`;
}

function drawLists() {
  const oldest = Number(recent.value) ? now() - Number(recent.value) : 0;
  const byName = new Map(students.map((student) => [student[0], student]));
  const shown = [...cells.values()].filter((cell) => inChapter(cell.part));
  const stuck = shown.filter((cell) => !cell.passed && cell.stuck && cell.last >= oldest)
    .sort((one, other) => one.stuck - other.stuck);
  const seen = [...hints.values()].filter((hint) => inChapter(hint.part))
    .sort((one, other) => other.students - one.students || other.count - one.count);
  list("stuck", "nobody", stuck, (cell) => [
    duration(now() - cell.stuck),
    cell.part,
    `${nameOf(byName.get(cell.student))}, ${triesOf(cell)}, last check ${duration(now() - cell.last)} ago`,
  ]);
  list("hints", "nothing", seen, (hint) => [
    `${hint.students === 1 ? "1 student" : `${hint.students} students`}, ${hint.count} ×`,
    hint.part,
    hint.text,
  ]);
  find("empty").hidden = shown.length > 0;
}

function list(id, none, items, texts) {
  const rows = items.slice(0, SHOWN).map((item) => {
    const row = document.createElement("li");
    row.append(...texts(item).map((text) => element("span", text)));
    return row;
  });
  if (items.length > SHOWN) rows.push(element("li", `${items.length - SHOWN} more`));
  find(id).replaceChildren(...rows);
  find(none).hidden = items.length > 0;
}

function draw() {
  drawTable();
  drawLists();
  for (const group of document.querySelectorAll("[data-chapter]")) {
    group.hidden = chapter.value !== "" && chapter.value !== group.dataset.chapter;
  }
}

function take(sent) {
  const first = cells.size === 0;
  if (sent.epoch !== epoch) {
    [cells, hints, layout] = [new Map(), new Map(), ""];
  }
  ({ epoch, version, students } = sent);
  offset = sent.now - Date.now() / 1000;
  for (const [student, part, tries, passed, stuck, last] of sent.cells) {
    cells.set(keyOf(student, part), { student, part, tries, passed, stuck, last });
  }
  for (const [part, text, count, number] of sent.hints) {
    hints.set(`${part} ${text}`, { part, text, count, students: number });
  }
  if (first && cells.size) {
    const latest = [...cells.values()].reduce((one, other) => (other.last > one.last ? other : one));
    const number = latest.part.slice(0, 2);
    if ([...chapter.options].some((each) => each.value === number)) chapter.value = number;
  }
  drawTable();
  const columns = parts();
  for (const [student, part] of sent.cells) {
    const field = fields.get(keyOf(student, part));
    if (field) fill(field, cells.get(keyOf(student, part)));
    drawSum(student, columns);
  }
  drawLists();
  document.body.dataset.version = version;
}

function say(text, lost) {
  const status = find("status");
  if (status.textContent !== text) status.textContent = text;
  status.classList.toggle("lost", lost);
}

async function follow() {
  for (;;) {
    try {
      const answer = await fetch(`changes?epoch=${epoch}&since=${version}`);
      if (answer.status === 403) {
        say("Your session has ended. Open the page again.", true);
        return;
      }
      if (!answer.ok) throw new Error(await answer.text());
      take(await answer.json());
      say("Live", false);
    } catch {
      say("No connection to the service; trying again …", true);
      await new Promise((resolve) => setTimeout(resolve, AGAIN));
    }
  }
}

function setHidden(value) {
  hide.setAttribute("aria-pressed", String(value));
  localStorage.setItem("course-class-hidden", value ? "yes" : "");
}

hide.addEventListener("click", () => {
  setHidden(!hidden());
  draw();
});
chapter.addEventListener("change", draw);
recent.addEventListener("change", draw);
setHidden(localStorage.getItem("course-class-hidden") === "yes");
draw();
setInterval(drawLists, TICK);
follow();
