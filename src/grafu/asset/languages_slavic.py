"""Words of furniture in Polish and Russian, as in `grafu.asset.languages`: the head noun comes first.

Polish stands without accents (`ł` is lost or written `l`), Russian in Latin letters, as `latin` writes it and as names
of files do: `Дверь левая` is `dver levaya`.
"""

from typing import Final

POLISH: Final = """
    door: drzwi drzwiczki skrzydlo skrzydo
    flap: klapa klapy
    lid: wieko pokrywa
    drawer: szuflada szuflady szuflad
    handle: uchwyt uchwyty uchwytu
    knob: galka gaka
    tabletop: blat
    back panel: plecy
    side panel: bok boki
    shelf: polka poka polki poki
    divider: przegroda
    leg: noga nogi nozka nozki
    hinge: zawias zawiasy
    rail: prowadnica prowadnice
    toe kick: cokol coko
    cabinet: szafa szafka szafy szafki komoda
    bookcase: regal rega
    carcass: korpus
    desk: biurko
    bed: lozko ozko
    mirror: lustro
    glass: szyba szyby szklo szko
    sliding: przesuwne przesuwny przesuwna; left: lewy lewa lewe; right: prawy prawa prawe
    upper: gorny gorna gorne; lower: dolny dolna dolne
"""

RUSSIAN: Final = """
    door: dver dveri dvertsa dverca stvorka dvertsy dvercy stvorki
    coverplate: kryshka
    drawer: yaschik yashchik yashik yaschika yashchika yaschiki yashchiki
    handle: ruchka ruchki
    tabletop: stoleshnitsa stoleshnica
    back panel: zadnik
    side panel: bokovina bokoviny
    bottom panel: dno
    shelf: polka polki
    divider: peregorodka
    leg: nozhka nozhki
    hinge: petlya petli
    rail: napravlyayuschaya napravlyayuschie
    toe kick: tsokol cokol
    front: fasad fasady
    cabinet: shkaf shkafa tumba komod
    carcass: korpus karkas
    table: stol stola
    bed: krovat
    mirror: zerkalo
    glass: steklo
    left: levaya levyy leviy; right: pravaya pravyy praviy
    upper: verhnyaya verhniy; lower: nizhnyaya nizhniy
"""

SLAVIC: Final = (POLISH, RUSSIAN)

# Each letter with its Latin ones; those without any are left out.
_LETTERS: Final = (
    "а:a б:b в:v г:g д:d е:e ё:e ж:zh з:z и:i й:y к:k л:l м:m н:n о:o п:p р:r с:s т:t у:u ф:f х:h ц:ts ч:ch ш:sh "
    "щ:sch ъ: ы:y ь: э:e ю:yu я:ya"
)
_PAIRS: Final = [pair.split(":") for pair in _LETTERS.split(" ")]
_TO_LATIN: Final = str.maketrans(dict(_PAIRS) | {small.upper(): into.capitalize() for small, into in _PAIRS})


def latin(name: str) -> str:
    """Returns a name with its Russian letters in Latin ones."""
    return name.translate(_TO_LATIN)
