// @ts-check
// The tables of a run: a heading sorts by its column, a word in the search box keeps the rows that hold it.

// Returns the order of two cells' values: numbers as numbers, words as words; what is missing is null.
function compared(a, b) {
  if (typeof a === "number" && typeof b === "number") return a - b;
  return String(a).localeCompare(String(b), "en", { numeric: true, sensitivity: "base" });
}

function valueOf(row, column) {
  const cell = row.cells[column], text = cell.dataset.value;
  if (text === "") return null;
  return cell.classList.contains("number") ? Number(text) : text;
}

// Sorts the rows of a table by a column; what is missing stays at the end either way.
function sortTable(table, column, falling) {
  const body = table.tBodies[0], keyed = [...body.rows].map((row) => ({ row, value: valueOf(row, column) }));
  keyed.sort((a, b) => {
    if (a.value === null || b.value === null) return Number(a.value === null) - Number(b.value === null);
    return falling ? compared(b.value, a.value) : compared(a.value, b.value);
  });
  body.append(...keyed.map(({ row }) => row));
  [...table.tHead.rows[0].cells].forEach((head, k) => {
    if (k === column) head.setAttribute("aria-sort", falling ? "descending" : "ascending");
    else head.removeAttribute("aria-sort");
  });
}

controlsAt("button[data-sort]").forEach((button) => {
  const head = /** @type {HTMLElement} */ (button.closest("th")), column = Number(button.dataset.sort);
  button.addEventListener("click", () => {
    const now = head.getAttribute("aria-sort"), numbers = head.classList.contains("number") && column > 0;
    sortTable(button.closest("table"), column, now ? now === "ascending" : numbers);  // of numbers the largest first
  });
});

controlsAt("input[data-filter]").forEach((box) => {
  const table = /** @type {HTMLTableElement} */ (elementAt("#" + box.dataset.filter)), rows = [...table.tBodies[0].rows];
  box.addEventListener("input", () => {
    const word = box.value.trim().toLowerCase();
    rows.forEach((row) => (row.hidden = !row.textContent.toLowerCase().includes(word)));
  });
});
