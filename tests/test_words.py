"""Words that the project no longer uses stay out of it: the field has a better one (docs/glossary.md)."""

import re
import subprocess
from pathlib import Path

import pytest

ROOT = Path(__file__).parent.parent
LOOKED_AT = (
    "src",
    "docs",
    "examples",
    "scripts",
    "blender_addon",
    "tests",
    "README.md",
    "CONTRIBUTING.md",
    "CHANGELOG.md",
)
TELLS_OLD_NAMES = re.compile(r"`[^`\n]*`")  # in the changelog: a name that was changed
EXEMPT = ("tests/test_words.py",)  # it holds the patterns

# A pattern, and the word that stands in its place. `_` parts words here, and so does a capital.
RETIRED = {
    r"\bKept\b|NOTHING_KEPT|MOST_KEPT|\bkept=": "cache",
    r"(?i)beliefs?(?![a-z])": "probabilities",
    r"(?i)ballots?(?![a-z])": "votes",
    r"(?i)(?<![a-z])sight(?![a-z])": "features, forward pass",
    r"(?i)(?<![a-z])movers?(?![a-z])": "moving body",
    r"(?i)(?<![a-z])riders?(?![a-z])": "attached part",
    r"\bWay\b|\bscene\.ways\b|\bmotion_about\b|\bway_box\b": "joint motion, path",
    r"(?i)untid(?:y|iness)|(?<![a-z])clutter": "modelling noise, loose objects",
    r"\bcarpenters?'? rules?\b|the carpenter\b": "rule-based baseline",
    r"(?i)(?<![a-z])lessons?(?![a-z])|syllabus|\bDealConfig\b|\bdeal\s*[=:]|\.deal\b": "sample, sampler, batch",
    r"\bMoves\.NOT\b|--move \S+=not\b": "fixed",
    r"\bLack\b|\blacks_of\b": "missing panel",
    r"(?i:unfurnished)|\bFreedom\b|freedom_of": "before interiors, cut-outs",
    r"(?i)how sure": "confidence",
    r"\b(?:somebody|anybody)\b": "the user, any source",
    r"\bcame of\b": "outcome",
    r"\bknows (no|nothing|neither)\b": "what the module does, said positively",
    r"(?i)\bstands? still\b|\bstanding still\b": "is static, does not move",
    r"(?i)\b(?<!was )made (furniture|models?)\b": "synthetic furniture, synthetic models",
    r"\bsays\b": "states, contains, is; the verb is for people",
    r"\bclosed (list|mesh|meshes)\b": "fixed list, watertight mesh",
    r"(?i)\b(parts|inputs|models|bodies) (and \w+ )?fraction\b|\bcall fraction\b": "the verb share",
}
RETIRED |= {
    r"(?i)\bnobody\b": "the passive voice",
    r"\b(is|are|was|were) told\b(?! apart)": "reported, passed, known",
    r"\blet[_ ]in\b|LET_IN": "inset",
    r"\b(asset|scene|view)\.unit\b|\blargest side is `unit`": "extent",
    r"\battention_shares\b|\bAveragedWeights\b": "attention_weights, AveragedModel",
    # As the name of a value, or where it is a distance; "in this way" and "in the way" are fine.
    r"\bways? = |\.ways?\b(?: ==|[,)\]])|\bways?\[|\bfor ways? in|\bin ways\b|, ways?: ": "path, direction",
    r"\b(?:of|on|along) the way (?:from|to|along|out)\b|\bon its way out\b|\bleaned_way\b": "path, distance",
    r"\bbare_(?:door|drawer|gap|width)\b|\bbare\.py\b|\bbare (?:door|drawer)\b": "without hardware",
    r"(?i)(?<![a-z])amiss(?![a-z])": "fault",
    r"\bstill_(?:lacking|fronts)\b|\blacks_table\b|\b_Look\b": "remaining deficiencies, parts without joint, finder",
    r"\bhidden_trim\b": "max_hidden_trim",
    r"\bcame about\b": "was made",
    r"\bmade (eased|smaller all round)|\bwithout play\b": "shrunk, without clearance",
    # The verb "to share" stays, and so do fields of report.json and of template annotations.
    r"(?i)\b(?:a|the|its|their|this|each|least|largest|in) shares?\b|\bshares? of\b": "ratio, fraction",
    r"\b(?!collision_|surface_|volume_|range_|random_)(?!test_)\w*[a-z]_shares?\b": "ratio, fraction",
    r"(?<!\.)\bshares? *=(?!half)": "ratio, fraction",
}
RETIRED |= {
    r"(?i)\bcarpenters?'?s? rules?\b|carpenter_rules|_the_carpenter\b": "rule-based baseline",
    r"\b(?:[Mm]odels|[Ff]urniture|[Cc]opies) without end\b|\bwith its truth\b": "endless stream, with ground truth",
    r"\bmjcf_looks\b|\bclass Look\b": "material",
    r"\bLACKING\b": "missing, incomplete",
    r"\bsaid\.txt\b": "output.txt",
}
RETIRED_HEADING = "## Words that are not used"


def texts() -> list[tuple[str, str]]:
    listed = subprocess.run(["git", "ls-files", *LOOKED_AT], cwd=ROOT, capture_output=True, text=True, check=False)
    if listed.returncode:
        pytest.skip("not a git checkout")
    names = [name for name in listed.stdout.splitlines() if (ROOT / name).is_file()]
    contents = [(name, (ROOT / name).read_bytes()) for name in names]
    texts = [(name, data.decode()) for name, data in contents if b"\0" not in data]
    return [(name, scanned(name, text)) for name, text in texts if name not in EXEMPT]


def scanned(name: str, text: str) -> str:
    """Returns what of a file is compared with the patterns: no list of retired words, no old names in backticks."""
    if name == "CHANGELOG.md":
        return TELLS_OLD_NAMES.sub("``", text)
    return text.split(RETIRED_HEADING)[0] if name == "docs/glossary.md" else text


def uses(name: str, text: str, pattern: re.Pattern[str]) -> list[str]:
    """Returns where a text or its file's name uses a retired word, a line for each."""
    if not (pattern.search(name) or pattern.search(text)):  # no pattern spans lines: line by line takes much longer
        return []
    lines = [(0, name), *enumerate(text.splitlines(), 1)]
    found = [(row, match[0]) for row, line in lines for match in pattern.finditer(line)]
    return [f"{name}:{row}: {word}" for row, word in found]


@pytest.fixture(scope="module")
def found_texts() -> list[tuple[str, str]]:
    return texts()


@pytest.mark.parametrize("pattern", RETIRED)
def test_retired_words_stay_out(pattern: str, found_texts: list[tuple[str, str]]) -> None:
    compiled = re.compile(pattern)

    found = [line for name, text in found_texts for line in uses(name, text, compiled)]

    assert found == [], f"the word is: {RETIRED[pattern]} (docs/glossary.md)"


def test_a_retired_word_is_found_in_text_and_in_a_name() -> None:
    pattern = re.compile(r"(?i)(?<![a-z])ballots?(?![a-z])")

    assert uses("src/a.py", "votes = 3\nmy_ballot = Ballot()", pattern) == ["src/a.py:2: ballot", "src/a.py:2: Ballot"]
    assert uses("src/ballot.py", "", pattern) == ["src/ballot.py:0: ballot"]


def test_the_glossary_lists_what_replaces_a_retired_word() -> None:
    _, listed = (ROOT / "docs" / "glossary.md").read_text().split(RETIRED_HEADING)
    words = {word for row in re.findall(r"^\| ([^|]+) \|", listed, re.MULTILINE) for word in row.split(", ")}

    assert words >= {"share", "unit", "let in", "eased", "nobody", "knows no"}


def test_the_glossary_defines_each_term_once() -> None:
    rows = re.findall(r"^\| ([^|]+) \| [^|]+ \| [^|]*\|$", (ROOT / "docs" / "glossary.md").read_text(), re.MULTILINE)
    terms = [term.strip() for row in rows if row != "term" for term in row.split(",")]

    assert len(terms) == len(set(terms)) > 50
