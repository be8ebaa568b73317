// @ts-check
// What the page asks the server: choices, what was built, and how things go. All addresses are below the page's own.

const STAGES = {
  wait: "waiting for the builder", load: "reading the parts", parse: "finding what touches",
  complete: "finding what moves", plan: "planning joints", close: "closing drawers that are drawn open",
  body: "building the body", realize: "fitting hinges and rails", fittings: "fitting handles and shelves",
  "small parts": "fitting knobs and wheels", "lift arms": "fitting lift arms", stays: "fitting stays",
  judge: "checking masses and collision shapes", match: "matching motions with parts", "grasp frames": "finding where grippers take hold", page: "drawing the page",
  export: "making the files", write: "writing",
};

class Server {
  constructor({ told, failed }) {
    this.told = told;
    this.failed = failed;
    this.held = { geometry: ["", null], textures: ["", null] };
    this.source = new EventSource("events");
    this.source.onmessage = ({ data }) => told(JSON.parse(data));
    this.source.onerror = () => failed("The server does not answer: start `grafu edit` again. What was chosen is saved.");
  }

  // Sends an action; returns what it answers, or null where one line states what is wrong.
  async act(name, body) {
    try {
      const answer = await fetch(name, {
        method: "POST", headers: { "content-type": "application/json" }, body: body && JSON.stringify(body),
      });
      const values = await answer.json();
      if (answer.ok) return values;
      this.failed(values.error);
    } catch {
      this.failed("The server does not answer: start `grafu edit` again. What was chosen is saved.");
    }
    return null;
  }

  choose(question, part, value) {
    return this.act("choose", { question, part, value });
  }

  // Returns the last build as a page shows it, without its scene.
  async state() {
    const answer = await fetch("state");
    if (!answer.ok) throw new Error("nothing is built");
    return answer.json();
  }

  // Returns the scene of a build, ready for upload, and its images.
  async sceneOf(state) {
    const buffer = await this.resource("geometry", state.geometry, (answer) => answer.arrayBuffer());
    const uris = await this.resource("textures", state.textures, (answer) => answer.json());
    const images = await Promise.all(uris.map(loadImage));
    return { scene: cutScene(state.scene, buffer), images };
  }

  async resource(name, digest, read) {
    if (this.held[name][0] !== digest) {
      const answer = await fetch(`${name}?${digest}`);
      if (!answer.ok) throw new Error("built anew meanwhile");
      this.held[name] = [digest, await read(answer)];
    }
    return this.held[name][1];
  }
}
