// @ts-check
// Joint values and the motion that they give every link; a joint behind a door waits until that is open, and a coupled
// joint follows its leader.

// Returns between which two of increasing values one lies, by their places, and what fraction of the way.
const between = (values, value) => {
  const kept = clamp(value, values[0], values[values.length - 1]);
  const after = Math.max(1, values.findIndex((one) => one >= kept)), before = after - 1;
  return [before, after, (kept - values[before]) / (values[after] - values[before])];
};

class Joints {
  constructor(scene) {
    this.joints = scene.joints;
    this.links = scene.links;
    this.stages = scene.stages;
    this.values = this.joints.map((joint) => joint.lower);
    this.joints.forEach((joint, k) => joint.coupling || this.follow(k));
    this.watchers = [];
    this.run = null;
  }

  // Brings the joints that are coupled to one in step with it.
  follow(index) {
    this.joints.forEach(({ coupling }, k) => {
      if (!coupling || coupling[0] !== index) return;
      this.values[k] = coupling[1] * this.values[index] + coupling[2];
      this.follow(k);
    });
  }

  onChange(watcher) {
    this.watchers.push(watcher);
  }

  // Sets a joint to a value, radians or metres. What it waits for opens first; what waits for it closes first. Of a
  // coupled joint the leader is moved so that it comes to that value.
  set(index, value) {
    const joint = this.joints[index];
    if (joint.coupling) {
      const [leader, multiplier, offset] = joint.coupling;
      this.set(leader, (value - offset) / multiplier);
      return;
    }
    const kept = clamp(value, joint.lower, joint.upper);
    if (kept > joint.lower) joint.after.forEach((other) => this.set(other, this.joints[other].upper));
    if (kept < joint.upper) {
      this.joints.forEach((other, k) => {
        if (other.after.includes(index) && this.values[k] > other.lower) this.set(k, other.lower);
      });
    }
    if (this.values[index] === kept) return;
    this.values[index] = kept;
    this.follow(index);
    this.watchers.forEach((watcher) => watcher());
  }

  fraction(index) {
    const { lower, upper } = this.joints[index];
    return upper > lower ? (this.values[index] - lower) / (upper - lower) : 0;
  }

  setFraction(index, fraction) {
    const { lower, upper } = this.joints[index];
    this.set(index, lower + fraction * (upper - lower));
  }

  // Returns the motion of every link from rest, in the order of the links, parents before children.
  poses() {
    const poses = [];
    for (const link of this.links) {
      const above = link.parent === null ? IDENTITY : poses[link.parent];
      const own = link.swing ? this.swing(link.swing) : link.joint === null ? IDENTITY : this.motion(link.joint);
      poses.push(product(above, own));
    }
    return poses;
  }

  // Returns the turn of a piece on its own pin: angles are tabled by values of a joint.
  swing({ joint, axis, values, angles }) {
    const [before, after, part] = between(values, this.values[joint]);
    return turn(axis[0], axis[1], angles[before] + part * (angles[after] - angles[before]));
  }

  motion(index) {
    const { motion: [turned, shifted], axis, slip } = this.joints[index], value = this.values[index];
    const about = turned ? turn(axis[0], axis[1], turned * value) : IDENTITY;
    const moved = shifted ? product(shift(times(axis[1], shifted * value)), about) : about;
    if (!slip) return moved;
    const [values, shifts] = slip, [before, after, part] = between(values, value);
    return product(shift(add(times(shifts[before], 1 - part), times(shifts[after], part))), moved);
  }

  // Moves all joints, stage after stage, to open (true) or closed; `again` is called when that is done.
  move(open, seconds, again = () => this.stop()) {
    const stages = (open ? this.stages : [...this.stages].reverse()).filter((stage) =>
      stage.some((k) => Math.abs(this.fraction(k) - (open ? 1 : 0)) > 1e-6));
    this.run = { stages, open, seconds, again, at: 0, time: 0, from: null };
  }

  // Moves one joint to open (true) or closed; a coupled one moves with its leader.
  moveOne(index, open, seconds) {
    this.run = { stages: [[this.leader(index)]], open, seconds, again: () => this.stop(), at: 0, time: 0, from: null };
  }

  // Returns the joint that a coupled one follows in the end, or itself.
  leader(index) {
    const { coupling } = this.joints[index];
    return coupling ? this.leader(coupling[0]) : index;
  }

  stop() {
    this.run = null;
  }

  // Goes on with what moves by itself; `elapsed` is seconds. Returns whether something does.
  step(elapsed) {
    const run = this.run;
    if (!run) return false;
    const stage = run.stages[run.at];
    if (!stage) {
      run.again();
      return this.run !== null;
    }
    const from = (run.from ??= stage.map((k) => this.fraction(k)));
    run.time += elapsed;
    const t = run.seconds > 0 ? clamp(run.time / run.seconds, 0, 1) : 1;
    const soft = t * t * (3 - 2 * t);
    stage.forEach((k, i) => this.setFraction(k, from[i] + ((run.open ? 1 : 0) - from[i]) * soft));
    if (t >= 1) Object.assign(run, { at: run.at + 1, time: 0, from: null });
    return true;
  }
}
