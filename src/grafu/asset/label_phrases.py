"""The English phrases that name parts, and the label that each gives; `grafu.asset.labels` holds their grammar."""

from typing import Final

from grafu.vocabulary import PartLabel

# Each row: a label and the phrases that give it. A phrase is words that adjoin (`drawer rail` also matches plurals);
# `=top` matches only where it is the whole name. The phrase that ends last counts, the longest of several.
TABLE: Final[tuple[tuple[PartLabel, str], ...]] = (
    (
        PartLabel.DRAWER,
        "drawer, pull out, pullout, slide out tray, keyboard tray, tray surface, =tray, sliding tray, sliding shelf",
    ),
    (PartLabel.DRAWER, "sliding rack, slide tray, keyboard shelf, keyboard drawer"),
    (PartLabel.DOOR, "door, door leaf, cabinetdoor, flap, lid, shutter, hatch, tambour, fallboard, keylid"),
    (PartLabel.HANDLE, "handle, doorhandle, knob, nob, doorknob, grip, handgrip, pull, grasp"),
    (PartLabel.MISC, "tabletop connector, drawer rail, drawer slider, drawer slide, drawer runner, hinge, lock"),
    (PartLabel.MISC, "dowel, confirmat, cam lock, shelf pin, shelf peg, shelf support, shelf bracket, mounting plate"),
    (PartLabel.MISC, "keyhole, screw, nail, bolt, wheel, caster, castor, button, switch, lever, dial, faucet, tap"),
    (
        PartLabel.MISC,
        "hinge leaf, hinge plate, hinge arm, knuckle, bearing, bearer, bracket, hanger, standoff, bushing",
    ),
    (PartLabel.MISC, "bumper, gasket, seal, spring, piston, damper, latch, catch, magnet, stopper, stop, spacer"),
    (PartLabel.MISC, "pedal, foot pedal"),
    (PartLabel.FACE_FRAME, "face frame, faceframe, front frame, stile, mullion, top rail, bottom rail, mid rail, jamb"),
    (
        PartLabel.FACE_FRAME,
        "doorframe, doorjamb, sidelight, filler panel, filler strip, filler piece, filler board, =filler",
    ),
    (PartLabel.FACE_FRAME, "blank panel, blanking panel, blind panel, infill panel, infill strip"),
    (PartLabel.FACE_FRAME, "lintel, fascia, front panel, fixed front, false front, cabinet frame, =frame, =front"),
    (PartLabel.LEG, "leg, foot, feet, pedestal"),
    (PartLabel.SHELF, "shelf, shelve, shelves, shelving, bookshelf, plank, rack"),
    (PartLabel.DIVIDER, "divider, partition, separator, middle panel, mid panel, centre panel, center panel"),
    (PartLabel.BAR, "bar, stretcher, rod, crossbar, beam, rung, slat, apron, strut, brace, batten, crosspiece, post"),
    (
        PartLabel.BACK_PANEL,
        "back panel, backpanel, backboard, back board, back plate, rear panel, back side, back wall",
    ),
    (PartLabel.BACK_PANEL, "rear wall, back skin, rear skin, cabinet back, carcass back, case back, =back, =rear"),
    (PartLabel.TOP_PANEL, "top panel, toppanel, tabletop, table top, countertop, counter top, counter, worktop"),
    (PartLabel.TOP_PANEL, "desktop, desk top, top board, top plate, top surface, board top, bench top, =board"),
    (PartLabel.TOP_PANEL, "cabinet top, carcass top, case top, body top, top slab, top skin, top deck, =top"),
    (PartLabel.BOTTOM_PANEL, "bottom panel, bottompanel, bottom board, bottom plate, base panel, floor panel"),
    (PartLabel.BOTTOM_PANEL, "base plate, cabinet bottom, carcass bottom, case bottom, bottom skin, =bottom"),
    (PartLabel.SIDE_PANEL, "side panel, sidepanel, side board, side plate, side wall, gable, toe kick, plinth, cheek"),
    (
        PartLabel.SIDE_PANEL,
        "kickboard, baseboard, skirting, end panel, left panel, right panel, outer side, inner side",
    ),
    (PartLabel.SIDE_PANEL, "kick board, kick plate, kickplate, kick panel, toe board, toe plate"),
    (PartLabel.SIDE_PANEL, "lateral panel, =lateral, wall"),
    (PartLabel.SIDE_PANEL, "left side, right side, cabinet side, carcass side, case side, side skin, left wall"),
    (PartLabel.SIDE_PANEL, "right wall, wall left, wall right, =side, =left, =right"),
    (
        PartLabel.MISC,
        "misc, connector, glass, pane, window, mirror, lamp, light, led, sink, basin, cushion, pillow, book, clock",
    ),
    (PartLabel.MISC, "decoration, cord, cable, hook, key, vase, rail, runner, slider, cloth, mattress, grille, vent"),
    (PartLabel.MISC, "blanket, quilt, duvet, bedspread, backrest, armrest, headrest, burner, hotplate, hob, cooktop"),
    (PartLabel.MISC, "bottle, bowl, cup, mug, candle, statue, plant, flower, lampshade, curtain, toilet, bidet"),
    (PartLabel.MISC, "gap, shadow, reveal, recess, cavity, slot, groove, trim, molding, moulding, bead, band"),
    (
        PartLabel.MISC,
        "control panel, display, slide, support, collar, sleeve, tube, ceiling, cover, handrail, rug, carpet",
    ),
)
