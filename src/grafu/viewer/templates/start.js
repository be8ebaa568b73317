// @ts-check
// The page of a disk: its data stand in it.

async function startModel() {
  const stage = document.getElementById("stage");
  if (!stage) return;
  try {
    const scene = await loadScene();
    const images = await Promise.all(scene.textures.map(loadImage));
    const view = new ModelView(stage);
    Object.assign(window, { grafu: view });
    view.show(scene, images);
    stage.classList.add("ready");
  } catch (error) {
    goWithout(stage, error.message || error);
  }
}

whenSeen().then(startModel);
