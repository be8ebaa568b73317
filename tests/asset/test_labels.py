import pytest
from hypothesis import given
from hypothesis import strategies as st

from grafu.asset.labels import (
    TABLE,
    _last,
    _rows,
    is_control,
    is_piece,
    is_whole_part,
    label_of,
    sense_of,
)
from grafu.asset.names import safe_id, singular, unique_ids, words
from grafu.vocabulary import PartLabel

NAMES = {
    PartLabel.TOP_PANEL: [
        "top_panel-3",
        "board-60",
        "tabletop",
        "Countertop.001",
        "top panel_2",
        "Top",
        "table_top_surface",
    ],
    PartLabel.SIDE_PANEL: [
        "vertical_side_panel-1",
        "SidePanelLeft",
        "side panel_0",
        "base_side_panel-9",
        "left side",
        "kick_plate",
        "KickPanel.001",
        "toe_board_2",
    ],
    PartLabel.BACK_PANEL: ["back_panel-5", "Back.002", "BackPanel", "back panel_1", "rear_panel"],
    PartLabel.BOTTOM_PANEL: ["bottom_panel-4", "bottom", "bottom panel_12"],
    PartLabel.FACE_FRAME: [
        "face frame_3",
        "face_frame",
        "stile_left",
        "bottom_rail",
        "front",
        "filler_panel_1",
        "BlindPanel",
        "sidelight_2",
        "Passblende",
    ],
    PartLabel.SHELF: ["shelf-6", "Shelves", "adjustable_shelf_02", "top_shelf"],
    PartLabel.DIVIDER: ["vertical_divider_panel-2", "divider_1", "Partition"],
    PartLabel.BAR: ["frame_horizontal_bar-45", "bar_stretcher-3", "crossbar", "bar_2"],
    PartLabel.LEG: ["leg-21", "foot-3", "Feet", "back_leg_left"],
    PartLabel.DOOR: [
        "cabinet_door_surface-7",
        "door_1",
        "DoorLeft",
        "glass_door",
        "lid",
        "Flap.003",
        "piano_fallboard",
        "top_door",
        "Türblende",
        "sidelight_door",
    ],
    PartLabel.DRAWER: [
        "drawer_front-9",
        "drawer_box",
        "Drawer01",
        "keyboard_tray_surface-2",
        "keyboard_shelf",
        "bottom_drawer",
        "pull-out",
    ],
    PartLabel.HANDLE: ["handle-8", "door_handle", "drawer_knob_2", "DoorPull", "door_right_nob", "handle_top"],
    PartLabel.MISC: [
        "blanket_Plane.003",
        "foot_pedal",
        "burner_2",
        "left_armrest",
        "flower_pot",
        "wheel-3",
        "caster_2",
        "drawer_rails-40",
        "door_hinge",
        "misc_4",
        "tabletop_connector-7",
        "mirror",
    ],
    PartLabel.UNKNOWN: ["other_leaf-22", "Cube.003", "part_0", "", "42", "Küche", "mesh25-geometry"],
}


@pytest.mark.parametrize(("label", "name"), [(label, name) for label, names in NAMES.items() for name in names])
def test_names_give_labels(label, name):
    assert label_of(name) is label


@pytest.mark.parametrize("label", [x for x in PartLabel if x is not PartLabel.UNKNOWN])
def test_the_official_spelling_gives_each_label(label):
    assert label_of(f"{label.value}_12") is label
    assert label_of(f"{label.value.replace(' ', '_')}_0") is label


def test_pieces_wholes_and_controls_are_told_apart():
    assert is_piece("drawer_front-3")
    assert not is_piece("drawer_3")
    assert is_whole_part("Door.001")
    assert not any(is_whole_part(n) for n in ("doors", "drawer_unit", "drawer_side", "shelf"))
    assert is_control("knob")
    assert is_control("Caster_2")
    assert is_control("heatknob")
    assert not is_control("door_knob")
    assert is_control("door_button-1")
    assert not is_control("button_drawer")
    assert is_control("door_button")
    assert not is_control("button_door")


@given(st.text(max_size=20), st.booleans())
def test_ids_are_safe(name, is_handle):
    found = safe_id(name, is_handle)
    assert found.isascii()
    assert found.isidentifier()
    assert found.startswith("handle") == is_handle
    assert not found.startswith(("hinge_", "rail_", "support_"))


@given(st.lists(st.tuples(st.sampled_from(["a", "a_2", "A b", "a b", "", "é"]), st.booleans()), max_size=12))
def test_ids_are_unique_and_the_first_keeps_its_name(names):
    ids = unique_ids(names)
    assert len(set(ids)) == len(ids)
    if names:
        assert ids[0] == safe_id(*names[0])


@given(st.text(alphabet="ab _", min_size=200, max_size=400), st.booleans())
def test_ids_of_long_names_leave_room_in_a_file_name(name, is_handle):
    first, second = unique_ids([(name, is_handle), (name, is_handle)])
    assert first != second
    assert max(len(first), len(second)) < 140
    assert first.isidentifier()


def test_words_part_camel_case_digits_and_signs():
    assert words("SidePanel_02.left-TOPDrawer") == ("side", "panel", "left", "top", "drawer")


COMPOUNDS = {
    PartLabel.MISC: [
        "drawer_0_left_rail",
        "deep_drawer_0_fixed_rail_a",
        "drawer_bearing_2",
        "reveal_drawer_gap",
        "lower_hinge_door_leaf",
        "handle_shadow",
        "knob_recess_0",
        "window_pane_on_hinge_1_mirror",
    ],
    PartLabel.TOP_PANEL: ["drawer_case_top", "top_slab"],
    PartLabel.SIDE_PANEL: ["drawer_cheek", "cavity_wall_left", "outer_side"],
    PartLabel.FACE_FRAME: ["drawer_lintel", "drawer_jamb_0", "Exterior_doorframe_PAINT"],
    PartLabel.DIVIDER: ["drawer_divider"],
    PartLabel.DOOR: [
        "opening_on_hinge_1_door",
        "sweethome3d_opening_on_hinge_1_door_PAINT",
        "hingeleftdoor.002",
        "microdoor",
        "leftGlassDoor",
        "door_stile_0",
    ],
    PartLabel.DRAWER: ["drawer of the desk", "Kitchen_drawer_main", "cabinet1_drawer_top_left", "drawer_0_left_side"],
    PartLabel.HANDLE: ["handle of the upper drawer", "drawerhandle", "handle_post_0", "Handle-Joint-top"],
    PartLabel.UNKNOWN: [
        "drawercase",
        "drawer_unit",
        "Korpus",
        "柜体",
        "Door-and-Drawers-Right.001",
        "drawers_or_doors",
    ],
}
LANGUAGES = {
    PartLabel.DOOR: [
        *("Schranktür links", "Schiebetuer_2", "porte gauche", "Armario_Puerta_Izq", "Anta.001", "porta do armário"),
        *("柜门_1", "推拉门", "左扉", "引き戸"),
        *("drzwi lewe", "Klapa.002", "Klappdeckel", "wieko", "Дверь левая", "дверца_2", "dver_pravaya"),
    ],
    PartLabel.DRAWER: [
        *("Schublade.003", "Schubladenfront", "tiroir du bas", "cajón 2", "cassetto_sinistro", "gaveta_1"),
        *("抽屉2", "引き出し_上", "szuflada_dolna", "Ящик 3", "Yaschik.003"),
    ],
    PartLabel.HANDLE: [
        *("Schubladengriff", "poignée de porte", "puerta_tirador", "maniglia anta", "puxador da gaveta"),
        *("抽屉把手", "扉の取っ手", "uchwyt szuflady", "Ручка двери", "ручка_ящика"),
    ],
    PartLabel.SHELF: [
        "Einlegeboden",
        "étagère_3",
        "estante",
        "ripiano",
        "prateleira",
        "层板",
        "棚板",
        "półka 1",
        "Полка",
    ],
    PartLabel.LEG: ["Tischbein", "pied de table", "pata_1", "gamba.002", "perna", "桌腿", "脚", "nóżka", "Ножка_4"],
    PartLabel.TOP_PANEL: ["Tischplatte", "dessus", "encimera", "tampo", "台面", "天板"],
    PartLabel.BACK_PANEL: ["Rückwand", "panneau arrière", "schienale", "背板"],
    PartLabel.SIDE_PANEL: ["Seitenwand", "fianco destro", "侧板"],
    PartLabel.UNKNOWN: ["Deckel 3", "крышка", "Kryshka_2", "盖板 48"],  # of a chest a lid, of a case its top
    PartLabel.MISC: [
        *("Scharnier", "charnière de porte", "bisagra", "cerniera", "dobradiça", "滑轨", "蝶番"),
        *("Bodenträger_2", "portaestante", "reggipiano", "shelf pin", "dowel 8x35", "confirmat 7x50", "cam lock 15"),
    ],
}


@pytest.mark.parametrize(("label", "name"), [(label, name) for label, names in COMPOUNDS.items() for name in names])
def test_the_head_noun_counts(label, name):
    assert label_of(name) is label


@pytest.mark.parametrize(("label", "name"), [(label, name) for label, names in LANGUAGES.items() for name in names])
def test_ten_languages_give_labels(label, name):
    assert label_of(name) is label


def test_words_behind_the_noun_that_nobody_knows_blur_a_name():
    assert sense_of("drawer_sprocket").is_blurred
    assert not sense_of("drawer_2_main").is_blurred
    assert not sense_of("front_drawer_c0_r2").is_blurred  # column and row
    assert not sense_of("frieze_drawer").is_blurred
    assert sense_of("sweethome3d_opening_on_hinge_1_door_sprocket").is_blurred
    assert sense_of("sweethome3d_opening_on_rail_2_door_glass").is_piece
    assert not is_whole_part("drawer_sprocket")
    assert sense_of("CabinetBody").is_container


@pytest.mark.parametrize(
    ("name", "label"),
    [
        ("kitchen_counter_marble.002", PartLabel.TOP_PANEL),
        ("counter_u1_side_left", PartLabel.UNKNOWN),  # a side of what is called a counter
        ("counter_back", PartLabel.UNKNOWN),
        ("counter_visitor_panel", PartLabel.UNKNOWN),
        ("cold_handle2_Circle.004", PartLabel.MISC),
        ("Hot_knob", PartLabel.MISC),
        ("hot_water_tank_door_handle", PartLabel.HANDLE),
        ("drawers_handle", PartLabel.HANDLE),
    ],
)
def test_handles_of_taps_are_on_no_door(name, label):
    assert label_of(name) is label


@pytest.mark.parametrize(
    ("name", "label", "is_piece"),
    [
        ("leftdoor_leftside_Plane.014_dark_walnut_jpg", PartLabel.DOOR, True),
        ("drawer_left_side_teak", PartLabel.DRAWER, True),
        ("drawer_cabinet_left_side_teak", PartLabel.SIDE_PANEL, False),
        ("drawer_side_rail_teak", PartLabel.MISC, False),
    ],
)
def test_strange_words_at_the_end_change_nothing_of_what_stands_before_them(name, label, is_piece):
    """The material is often the end of a name; where a door is, is no panel of the case."""
    assert (label_of(name), sense_of(name).is_piece) == (label, is_piece)


_WORDS = sorted({singular(w) for _, row in TABLE for w in row.replace(",", " ").replace("=", " ").split()})


@given(st.lists(st.sampled_from(_WORDS), max_size=6))
def test_the_phrase_that_ends_last_counts_the_longest_and_first_of_several(said):
    every = [
        (label, tuple(singular(w) for w in p.strip().lstrip("=").split()), p.strip().startswith("="))
        for label, row in TABLE
        for p in row.split(",")
    ]
    places = [
        (i, i + len(phrase), label)
        for label, phrase, whole in every
        for i in range(len(said) - len(phrase) + 1)
        if tuple(said[i : i + len(phrase)]) == phrase and (not whole or len(said) == len(phrase))
    ]
    best = max(places, key=lambda place: (place[1], place[1] - place[0]), default=None)
    assert _last(tuple(said), _rows(frozenset(PartLabel))) == best


@pytest.mark.parametrize(
    ("name", "label"),
    [
        ("fixed_rail_drawer_0_1", PartLabel.MISC),
        ("runner_drawer_2_left", PartLabel.MISC),
        ("hinge_plate_left_door", PartLabel.MISC),
        ("slide_drawer_1", PartLabel.DRAWER),
        ("hinge_door_1", PartLabel.DOOR),
        ("plate_door", PartLabel.DOOR),
        ("opening_on_rail_1_door", PartLabel.DOOR),
    ],
)
def test_a_fitting_named_before_what_it_is_on_is_no_door_or_drawer(name: str, label: PartLabel) -> None:
    assert label_of(name) is label
