// @ts-check
// The sliders, buttons and switches beside the 3D view. The page holds them already; here they begin to act.

const SECONDS = 1.2; // a stage of opening
const PAUSE = 0.7; // seconds at either end while it plays

class Controls {
  constructor(root, joints, view, { changed, focused }) {
    this.root = root;
    this.joints = joints;
    this.view = view;
    this.changed = changed;
    this.sliders = [...root.querySelectorAll("input[data-joint]")];
    this.sliders.forEach((slider) => {
      const index = Number(slider.dataset.joint);
      slider.disabled = false;
      slider.addEventListener("input", () => {
        this.playing(false);
        joints.setFraction(index, slider.value / slider.max);
      });
      const row = slider.closest(".joint");
      for (const name of ["pointerenter", "focusin"]) row.addEventListener(name, () => focused(index));
      for (const name of ["pointerleave", "focusout"]) row.addEventListener(name, () => focused(null));
    });
    this.button("open", () => this.start(true));
    this.button("close", () => this.start(false));
    this.button("play", () => (this.isPlaying ? this.playing(false) : this.play()));
    root.querySelectorAll("input[data-switch]").forEach((box) => {
      box.disabled = false;
      box.addEventListener("change", () => {
        view[box.dataset.switch] = box.checked;
        changed();
      });
      view[box.dataset.switch] = box.checked;
    });
    joints.onChange(() => this.show());
    this.isPlaying = false;
    this.show();
  }

  button(action, act) {
    const button = this.root.querySelector(`button[data-action="${action}"]`);
    if (!button) return;
    button.disabled = false;
    button.addEventListener("click", act);
  }

  start(open) {
    this.playing(false);
    this.joints.move(open, this.calm() ? 0 : SECONDS / 2);
    this.changed();
  }

  play() {
    this.playing(true);
    const next = (open) => this.joints.move(open, SECONDS, () => this.pause(() => next(!open)));
    next(!this.joints.joints.every((_, k) => this.joints.fraction(k) > 0.99));
    this.changed();
  }

  pause(then) {
    this.joints.stop();
    this.timer = setTimeout(() => {
      then();
      this.changed();
    }, PAUSE * 1000);
  }

  playing(on) {
    clearTimeout(this.timer);
    this.joints.stop();
    this.isPlaying = on;
    const button = this.root.querySelector('button[data-action="play"]');
    if (!button) return;
    button.setAttribute("aria-pressed", String(on));
    button.textContent = on ? "Pause" : "Play";
  }

  calm() {
    return matchMedia("(prefers-reduced-motion: reduce)").matches;
  }

  // Brings sliders and words in line with the values.
  show() {
    this.sliders.forEach((slider) => {
      const index = Number(slider.dataset.joint), fraction = this.joints.fraction(index);
      if (Math.abs(slider.value / slider.max - fraction) > 0.5 / slider.max) slider.value = Math.round(fraction * slider.max);
      const said = amount(this.joints.joints[index], this.joints.values[index]);
      slider.style.setProperty("--fraction", fraction);
      slider.setAttribute("aria-valuetext", said);
      slider.closest(".joint").querySelector("output").textContent = said;
    });
    this.changed();
  }
}

function amount(joint, value) {
  const [factor, digits, suffix] = joint.shown;
  return `${(value * factor).toFixed(digits)}${suffix}`;
}
