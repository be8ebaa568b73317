"""A model as MJCF, opened in MuJoCo by a force along or about each joint."""

import mujoco
import numpy as np

import grafu

folder = grafu.functionalize("samples/sideboard.glb").save("results/mujoco", formats="mjcf", overwrite=True)

model = mujoco.MjModel.from_xml_path(str(folder / "model.xml"))
for k in range(model.njnt):
    data = mujoco.MjData(model)
    slides = model.jnt_type[k] == mujoco.mjtJoint.mjJNT_SLIDE
    for _ in range(int(2.0 / model.opt.timestep)):
        data.qfrc_applied[model.jnt_dofadr[k]] = 10.0 if slides else 3.0
        mujoco.mj_step(model, data)
    value, upper = data.qpos[model.jnt_qposadr[k]], model.jnt_range[k][1]
    print(f"{model.joint(k).name}: pulled to {value:.2f} of {upper:.2f} {'m' if slides else 'rad'}")
    assert np.isfinite(data.qpos).all()
