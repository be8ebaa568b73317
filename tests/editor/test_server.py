"""The server: who is refused, what is built and saved, and what a killed server leaves behind."""

import asyncio
import json
from math import pi

import pytest
from editing import ATTACK, DOOR, DRAWER, PORT, TOKEN, Editing, Inside

from grafu.asset.load import load_asset
from grafu.asset.regrouping import regrouped
from grafu.editor.access import POLICY
from grafu.editor.session import Session
from grafu.editor.workspace import open_all
from grafu.errors import ExportError, UnreadableAsset
from grafu.evaluation.dataset import category_of, files_of_model, find_models, load_model
from grafu.pipeline.decisions import DECISIONS
from grafu.pipeline.settings import settings_from_bytes
from grafu.vocabulary import JointType

ROUTES = ("/", "/style.css", "/edit.js", "/m/0/", "/m/0/state", "/m/0/geometry", "/m/0/events", "/thumbnail/0", "/none")


def saved(editing):
    data = (editing.sessions[0].workspace.folder / "settings.json").read_bytes()
    return settings_from_bytes(data, "settings")


def motion_of(state, part):
    return next((joint for joint in state["report"]["joints"] if joint["part"] == part), None)


@pytest.mark.parametrize("route", ROUTES)
@pytest.mark.parametrize("prefix", ["", "/another-token", f"/{TOKEN}x", f"/{TOKEN[:-1]}", f"/x/{TOKEN}"])
def test_without_the_token_everything_is_refused(editing, route, prefix):
    answer = editing.client.get(f"{prefix}{route}")
    assert answer.status_code == 403
    assert TOKEN not in answer.text
    assert answer.headers["content-security-policy"] == POLICY


@pytest.mark.parametrize(
    ("headers", "status"),
    [
        ({}, 200),
        ({"host": f"localhost:{PORT}"}, 200),
        ({"origin": f"http://127.0.0.1:{PORT}"}, 200),
        ({"host": f"evil.example:{PORT}"}, 403),
        ({"host": "127.0.0.1"}, 403),
        ({"host": f"127.0.0.1.evil.example:{PORT}"}, 403),
        ({"origin": "http://evil.example"}, 403),
        ({"origin": "null"}, 403),
    ],
)
def test_another_host_or_origin_is_refused(editing, headers, status):
    assert editing.get("/style.css", headers=headers).status_code == status


def test_every_answer_forbids_all_else(editing):
    for route in ("/style.css", "/m/0/", "/none"):
        headers = editing.get(route).headers
        assert headers["content-security-policy"] == POLICY
        assert headers["cache-control"] == "no-store"
        assert headers["referrer-policy"] == "no-referrer"
    assert "unsafe" not in POLICY
    assert "http" not in POLICY


def test_a_choice_is_built_saved_and_recorded(editing):
    before = editing.open()
    word = "right" if before["motions"][DOOR]["side"] == "left" else "left"
    after = editing.choose("motion", DOOR, word)

    assert after["motions"][DOOR]["side"] == word
    assert str(saved(editing).motions[DOOR].side) == word
    (line,) = (editing.sessions[0].workspace.folder / DECISIONS).read_text().splitlines()
    record = json.loads(line)
    assert record["predicted"]["choice"] == before["motions"][DOOR]["side"]
    assert record["chosen"] == word


def test_undo_and_redo(editing):
    editing.open()
    chosen = editing.choose("motion", DOOR, "fixed")
    assert motion_of(chosen, DOOR) is None
    assert editing.post("/m/0/undo").json()["redo"] == 1
    assert motion_of(editing.settled(), DOOR) is not None
    assert saved(editing).motions == {}
    editing.post("/m/0/redo")
    assert motion_of(editing.settled(), DOOR) is None
    assert str(saved(editing).motions[DOOR].moves) == "fixed"


def test_parts_are_joined_as_the_settings_state(editing, model):
    names = [part["id"] for part in editing.open()["report"]["parts"]]
    host, other = [name for name in names if name.startswith(("side", "back", "bottom"))][:2]
    joined = editing.choose("join", host, other)
    left = [part["id"] for part in joined["report"]["parts"]]
    assert left == [name for name in names if name != other]
    assert [part.id for part in regrouped(load_asset(model), saved(editing).regrouped).parts] == left
    editing.post("/m/0/undo")
    assert [part["id"] for part in editing.settled()["report"]["parts"]] == names
    assert saved(editing).regrouped == ()


def test_a_part_of_one_shell_is_not_split(editing):
    names = {part["id"] for part in editing.open()["report"]["parts"]}
    editing.post(
        "/m/0/choose",
        {"question": "split", "part": next(name for name in names if name.startswith("side")), "value": None},
    )
    editing.settled()
    assert "one connected shell" in editing.sessions[0].error
    assert saved(editing).regrouped == ()


@pytest.mark.parametrize(
    "body",
    [
        {"question": "motion", "part": "gate", "value": "left"},
        {"question": "motion", "part": DOOR, "value": "sideways"},
        {"question": ["motion"], "part": DOOR},
        {"part": DOOR},
        [1, 2],
        "x" * 70000,
    ],
)
def test_a_bad_choice_is_one_line_and_changes_nothing(editing, body):
    editing.open()
    answer = editing.post("/m/0/choose", body)
    assert answer.status_code == 400
    assert len(answer.json()["error"].splitlines()) == 1
    assert editing.sessions[0].history.past == ()
    assert not (editing.sessions[0].workspace.folder / "settings.json").exists()


def test_a_choice_that_cannot_be_built_is_taken_back(editing):
    editing.open()
    editing.post("/m/0/choose", {"question": "motion", "part": DOOR, "value": "front"})
    state = editing.settled()
    session = editing.sessions[0]
    assert "broad face" in session.error
    assert session.history.past == ()
    assert saved(editing).motions == {} == state["settings"]["motions"]
    assert not (session.workspace.folder / DECISIONS).exists()


def test_only_the_files_of_the_last_build_are_given(editing):
    state = editing.open()
    assert len(editing.get(f"/m/0/geometry?{state['geometry']}").content) > 1000
    assert editing.get(f"/m/0/textures?{state['textures']}").json() == []
    for other in ("", "?", f"?{state['textures']}", f"?{state['geometry']}x"):
        assert editing.get(f"/m/0/geometry{other}").status_code == 400


def test_a_hostile_name_stays_text(editing):
    state = editing.open()
    assert ATTACK in {part["source"]["name"] for part in state["report"]["parts"]}
    assert all(ATTACK not in markup and "<script" not in markup for markup in state["markup"].values())


def test_export_writes_every_format_and_keeps_the_decisions(editing):
    editing.open()
    editing.choose("motion", DOOR, "fixed")
    done = editing.post("/m/0/export").json()
    folder = editing.sessions[0].workspace.folder
    assert {"glb", "urdf", "mjcf"} <= set(done["formats"])
    for name in ("model.glb", "model.urdf", "model.xml", "report.json", "report.html", "settings.json", DECISIONS):
        assert (folder / name).is_file(), name
    assert str(saved(editing).motions[DOOR].moves) == "fixed"


def test_a_chosen_handle_can_be_left_out_and_its_offset_is_limited(editing):
    editing.open()
    (handle,) = [one for one in editing.choose("handle", DOOR, "knob-round")["report"]["added"] if one["link"] == DOOR]
    (left, right), (down, up) = editing.settled()["rooms"][DOOR]
    assert 0.3 < right - left < 0.5
    assert 0.5 < up - down < 0.9
    room = editing.choose("handle offset", DOOR, [left / 2, up / 2])["rooms"][DOOR]
    assert [*room[0], *room[1]] == pytest.approx([left, right, down, up], abs=1e-6)  # it is where, not how much farther
    for value in ([left - 0.01, 0], [0, up + 0.01], [5, 5]):
        answer = editing.post("/m/0/choose", {"question": "handle offset", "part": DOOR, "value": value})
        assert (answer.status_code, "metres" in answer.json()["error"]) == (400, True)
    left_out = editing.choose("reject", handle["part"], None)
    assert [one["part"] for one in left_out["report"]["added"] if one["link"] == DOOR] == []
    assert DOOR not in left_out["rooms"]
    own = {one["name"] for one in left_out["scene"]["items"] if one["label"] == "handle" and one["role"] == "part"}
    assert own == {"handle_1", "handle_2"}  # those that the input had


def test_a_front_with_a_grip_cut_into_it_is_fixed_by_reject(editing):
    editing.open()
    cut = editing.choose("handle", DOOR, "hole")
    assert DOOR in {one["part"] for one in cut["report"]["carved"]}
    assert motion_of(editing.choose("reject", DOOR, None), DOOR) is None
    assert saved(editing).additions.rejected == frozenset()


def test_what_was_chosen_survives_a_killed_server(editing, model, tmp_path):
    editing.open()
    editing.choose("motion", DOOR, "fixed")
    again = open_all([model], tmp_path / "out")
    with Editing(again, tmp_path / "other", Inside()) as other:
        assert motion_of(other.open(), DOOR) is None
        folder = again[0].folder
        assert len((folder / DECISIONS).read_text().splitlines()) == 1
        other.post("/m/0/anew")
        assert motion_of(other.settled(), DOOR) is not None


def test_a_result_is_opened_with_its_settings(editing, model, tmp_path):
    editing.open()
    editing.choose("motion", DOOR, "fixed")
    editing.post("/m/0/export")
    for path in (tmp_path / "out" / "cabinet", tmp_path / "out"):
        (found,) = open_all([path], tmp_path / "elsewhere")
        assert found.source == model
        assert str(found.settings.motions[DOOR].moves) == "fixed"


def test_what_was_decided_is_ground_truth_of_an_evaluation(editing, model, tmp_path):
    before = editing.open()["motions"][DOOR]["side"]
    editing.choose("motion", DOOR, "right" if before == "left" else "left")
    editing.choose("turn", DOOR, 60)
    editing.choose("accept", DRAWER, None)
    editing.post("/m/0/export")
    (found,) = find_models(tmp_path / "out")
    assert (found.id, found.kind, category_of(found)) == ("cabinet", "decided", "decided")
    assert model in files_of_model(found)
    truth = load_model(found)
    joints = {joint.part: joint for joint in truth.stated_joints}
    assert joints.keys() == {DOOR, DRAWER}
    door, box = joints[DOOR], truth.part(DOOR).box
    assert (door.type, door.limited, joints[DRAWER].limited) == (JointType.REVOLUTE, True, False)
    assert door.upper == pytest.approx(pi / 3)
    assert door.axis.point[0] == pytest.approx(box.high[0] if before == "left" else box.low[0], abs=0.02)
    assert abs(door.axis.direction[2]) == pytest.approx(1.0)

    decisions = tmp_path / "out" / "cabinet" / DECISIONS
    record = json.loads(decisions.read_text().splitlines()[0])
    with decisions.open("a") as stream:
        stream.write(json.dumps({**record, "part": "side", "chosen": "sideways"}) + "\n")
    with pytest.raises(UnreadableAsset, match="'sideways'"):
        load_model(found)


def test_results_that_cannot_be_edited_are_left_out_of_a_folder(editing, tmp_path):
    editing.open()
    editing.post("/m/0/export")
    results, heard = tmp_path / "out", []
    (results / "gone").mkdir()
    report = json.loads((results / "cabinet" / "report.json").read_text())
    report["input"]["path"] = "gone.glb"
    (results / "gone" / "report.json").write_text(json.dumps(report))
    (results / "gone" / "model.glb").write_bytes((results / "cabinet" / "model.glb").read_bytes())
    assert [one.name for one in open_all([results], tmp_path / "elsewhere", on_left_out=heard.append)] == ["cabinet"]
    assert "its input is gone" in heard[0]
    with pytest.raises(UnreadableAsset, match="its input is gone"):
        open_all([results / "gone"], tmp_path / "elsewhere")


def test_a_folder_that_is_not_ours_is_never_written(model, tmp_path):
    (tmp_path / "out" / "cabinet").mkdir(parents=True)
    (tmp_path / "out" / "cabinet" / "thesis.txt").write_text("mine")
    with pytest.raises(ExportError):
        open_all([model], tmp_path / "out")
    with pytest.raises(UnreadableAsset, match="there is no"):
        open_all([tmp_path / "nothing.glb"], tmp_path / "out")
    (tmp_path / "notes.md").write_text("no model")
    with pytest.raises(UnreadableAsset, match="not a kind of file that is read"):
        open_all([tmp_path / "notes.md"], tmp_path / "out")
    with pytest.raises(UnreadableAsset, match="open them apart"):
        open_all([model, model], tmp_path / "results")


def test_the_wall_shows_every_model_with_its_light(editing, model, tmp_path):
    editing.open()
    editing.post("/m/0/export")
    more = tmp_path / "more.glb"
    more.write_bytes(model.read_bytes())
    found = open_all([tmp_path / "out" / "cabinet", more], tmp_path / "second")
    with Editing(found, tmp_path / "other", Inside()) as wall:
        page = wall.get("/").text
        assert page.count("data-words") == 2
        assert 'class="light new"' in page
        assert wall.get("/thumbnail/0").headers["content-type"] == "image/webp"
        assert wall.get("/thumbnail/1").status_code == 404
        assert wall.get("/m/2/").status_code == 400
    assert editing.get("/", follow_redirects=False).headers["location"] == "m/0/"


def test_stages_are_told_in_order(editing, model, tmp_path):
    async def told() -> list[str]:
        (workspace,) = open_all([model], tmp_path / "out")
        folder = tmp_path / "told"
        folder.mkdir()
        session = Session(workspace, Inside(), folder)
        stages: list[str] = []

        async def listen() -> None:
            async for event in session.events():
                stages.append(event["stage"])
                if event["build"]:
                    return

        listening = asyncio.create_task(listen())
        await asyncio.sleep(0)
        session.build()
        await asyncio.wait_for(listening, 60)
        return list(dict.fromkeys(stages))

    stages = asyncio.run(told())
    assert stages[:2] == ["", "wait"]
    assert [stage for stage in stages if stage in ("parse", "plan", "realize", "write")] == [
        "parse", "plan", "realize", "write",
    ]  # fmt: skip
