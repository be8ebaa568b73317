// @ts-check
// Fields in which something is typed: what is typed and not sent yet stays, what cannot be is refused beside the field.

// Returns the number in a field; null: none.
const entered = (field) => (field.value.trim() === "" ? null : Number(field.value));

// Shows a value in a field; what the user is typing there about the same thing stays, and so does what was refused.
function put(field, value, about = "") {
  if ((isUnsent(field) || field.hasAttribute("aria-invalid")) && field.dataset.about === about) return;
  if (field.value !== value || field.validity.badInput) field.value = value;
  Object.assign(field.dataset, { put: value, about });
  complain(field, "");
}

// Whether a field has the focus and holds what was not sent.
function isUnsent(field) {
  const { put: known } = field.dataset;
  return document.activeElement === field && known !== undefined && (field.value !== known || field.validity.badInput);
}

// Returns whether what was entered may be sent; what may not is refused in words, and stays to be mended.
function mayBeSent(field) {
  const may = field.checkValidity(), whole = field.step === "1" ? "a whole number " : "";
  complain(field, may ? "" : `${whole}from ${field.min} to ${field.max}${field.dataset.unit ? ` ${field.dataset.unit}` : ""}`);
  if (may) field.dataset.put = field.value;
  return may;
}

function limit(field, [least, most], unit) {
  Object.assign(field, { min: String(least), max: String(most) });
  field.dataset.unit = unit;
}

// States beside a field what is wrong with it; nothing: it is right.
function complain(field, why) {
  const label = field.closest("label"), next = label.nextElementSibling;
  const line = next?.classList.contains("refused") ? next : null;
  field.toggleAttribute("aria-invalid", Boolean(why));
  if (!why) {
    line?.remove();
    field.removeAttribute("aria-describedby");
    return;
  }
  const said = line ?? Object.assign(document.createElement("p"), { className: "refused" });
  said.id = "refused-" + (field.dataset.choice ?? field.dataset.offset ?? field.dataset.shelves);
  said.setAttribute("role", "alert");
  if (!line) label.after(said);
  said.textContent = why;
  field.setAttribute("aria-describedby", said.id);
  field.setAttribute("aria-invalid", "true");
}
