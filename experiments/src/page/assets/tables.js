// Tables: long ones are made when they are looked at; all of more than a few rows can be sorted, and long ones filtered.

const FEW = 5;

/** A number as it is read: whole ones in groups of three digits, others with four digits, like `table.rs`. */
function formatted(text) {
  if (/^-?\d{5,}$/.test(text)) return text.replace(/\B(?=(\d{3})+$)/g, ",");
  const x = Number(text);
  if (text.replace("-", "").length <= 6 || x === 0 || Number.isNaN(x) || /^-?\d+$/.test(text)) return text;
  if (Math.abs(x) >= 1e4) return formatted(x.toFixed(0));
  if (Math.abs(x) < 1e-4) return x.toExponential(3);
  return String(Number(x.toPrecision(4)));
}

/** The number that a cell shows. */
const numberIn = (cell) => parseFloat(cell.textContent.replaceAll(",", ""));

/** Puts the rows of a long table in, once. */
function fillTable(table) {
  const body = table.tBodies[0];
  if (body.rows.length > 0 || !table.dataset.rows) return;
  const numeric = [...table.tHead.rows[0].cells].map((cell) => cell.classList.contains("n"));
  const rows = JSON.parse(document.getElementById(table.dataset.rows).textContent).split("\n");
  const fragment = document.createDocumentFragment();
  for (const row of rows) {
    const tr = document.createElement("tr");
    row.split("\t").forEach((text, i) => {
      const td = document.createElement("td");
      td.textContent = text === "true" ? "yes" : text === "false" ? "no" : numeric[i] ? formatted(text) : text;
      if (numeric[i]) td.className = "n";
      tr.append(td);
    });
    fragment.append(tr);
  }
  body.append(fragment);
}

/** Sorts by a column: numbers as numbers, nothing last. */
function sortTable(table, column, descending) {
  const body = table.tBodies[0];
  const numeric = table.tHead.rows[0].cells[column].classList.contains("n");
  const keyed = [...body.rows].map((row) => {
    const text = row.cells[column].textContent;
    return { row, text, key: numeric ? numberIn(row.cells[column]) : text };
  });
  const compare = (a, b) => {
    if ((a.text === "") !== (b.text === "")) return a.text === "" ? 1 : -1;
    const order = numeric ? a.key - b.key : a.key.localeCompare(b.key, "en", { numeric: true });
    return descending ? -order : order;
  };
  keyed.sort(compare).forEach(({ row }) => body.append(row));
}

function makeSortable(table) {
  const headers = [...table.tHead.rows[0].cells];
  headers.forEach((header, column) => {
    const name = header.querySelector("span");
    const button = document.createElement("button");
    button.type = "button";
    button.textContent = name.textContent;
    name.replaceChildren(button);
    button.addEventListener("click", () => {
      const descending = header.getAttribute("aria-sort") === "ascending";
      headers.forEach((other) => other.removeAttribute("aria-sort"));
      header.setAttribute("aria-sort", descending ? "descending" : "ascending");
      fillTable(table);
      sortTable(table, column, descending);
    });
  });
}

/** A field above a long table: rows without any of its words disappear. */
function makeFilterable(table) {
  const label = document.createElement("label");
  label.className = "filter";
  label.innerHTML = "Rows with <input type=\"search\" placeholder=\"words, e.g. lattice f64\"> <output></output>";
  table.closest(".scroll").before(label);
  const [input, output] = [label.querySelector("input"), label.querySelector("output")];
  input.addEventListener("input", () => {
    fillTable(table);
    const words = input.value.toLowerCase().split(/\s+/).filter((word) => word !== "");
    let shown = 0;
    for (const row of table.tBodies[0].rows) {
      const text = [...row.cells].map((cell) => cell.textContent.toLowerCase()).join("\t");
      row.hidden = !words.every((word) => text.includes(word));
      if (!row.hidden) shown += 1;
    }
    output.textContent = words.length > 0 ? `${shown} of ${table.tBodies[0].rows.length}` : "";
  });
}

document.querySelectorAll("table.data").forEach((table) => {
  const long = Boolean(table.dataset.rows);
  if (long || table.tBodies[0].rows.length > FEW) makeSortable(table);
  if (long || table.tBodies[0].rows.length > 40) makeFilterable(table);
  const details = table.closest("details");
  if (!long) return;
  if (details === null || details.open) fillTable(table);
  else details.addEventListener("toggle", () => fillTable(table));
});

/** Says below a table that there is more of it beside what is seen. */
const seen = new ResizeObserver((entries) => entries.forEach(({ target }) => {
  const box = target.closest(".scroll");
  box.nextElementSibling.classList.toggle("shown", box.scrollWidth - box.clientWidth > 2);
}));
document.querySelectorAll(".scroll").forEach((box) => {
  const hint = document.createElement("p");
  hint.className = "more";
  hint.textContent = "The table is wider than the page: scroll sideways →";
  box.after(hint);
  seen.observe(box);
  seen.observe(box.firstElementChild);
});
