// @ts-check
// What is shown and how: switches, the part under the pointer, the part that was chosen. It draws nothing.

const PLAIN = { texture: null, metallic: 0, roughness: 0.7, emissive: [0, 0, 0], mode: "OPAQUE", cutoff: 0.5 };
const STEEL = { ...PLAIN, color: [0.5, 0.5, 0.52, 1], metallic: 1, roughness: 0.4 };

class View {
  constructor(scene) {
    this.scene = scene;
    this.hardware = true;
    this.added = true;
    this.categories = false;
    this.hovered = -1;
    this.chosen = -1;
    this.joint = null;
    this.clashing = new Set(); // items that are shown in red
    this.shadow = 0.5;
    this.accent = [0.05, 0.3, 0.75];
  }

  shows(piece) {
    const { role } = this.scene.items[piece.item];
    return (role !== "hardware" || this.hardware) && (role !== "added" || this.added);
  }

  look(piece) {
    const item = this.scene.items[piece.item];
    if (!this.categories) return this.scene.materials[piece.material];
    return item.role === "hardware" ? STEEL : { ...PLAIN, color: [...this.scene.categories[item.label], 1] };
  }

  alpha(piece) {
    const { color, mode } = this.look(piece);
    return mode === "BLEND" ? color[3] : 1;
  }

  // Returns a colour to mix in, and how much of it.
  mark(piece) {
    if (this.clashing.has(piece.item)) return [0.8, 0.01, 0.01, 0.65];
    const lit = piece.item === this.chosen ? 0.5 : piece.item === this.hovered ? 0.32 : 0;
    return [...this.accent, lit];
  }
}
