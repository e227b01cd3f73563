#!/usr/bin/env python3
"""Plants the same mistakes in a scene of each renderer, and writes what each says about them to docs/mistakes.md.

    python3 benches/mistakes/compare.py

A folder per renderer holds one good scene and `planted.toml`, the mistakes as changes of text. Every mistake is rendered
alone, then all at once; `--scenes DIR` writes these scenes for you to read. How a report is judged is said once, in `judge`, and once in words, in `METHOD`. A renderer that is
not installed is left out: `povray` and `snell` are looked for as commands, `mitsuba` and `pyluxcore` beside this Python.

Python 3.11 or later, its standard library only.
"""

import argparse
import difflib
import importlib.util
import os
import re
import shutil
import subprocess
import sys
import tempfile
import textwrap
import tomllib
from collections import namedtuple
from dataclasses import dataclass, field
from pathlib import Path

HERE = Path(__file__).resolve().parent
ROOT = HERE.parent.parent
SECONDS = 60


# ── The renderers ────────────────────────────────────────────────────────────────────────────────────────────────────


@dataclass
class Renderer:
    """One renderer: how it is run, and how its messages are read."""

    name: str
    folder: str
    command: list  # started in a copy of the folder
    version: str
    place: str  # groups `file`, `line` and `column`, as far as they are given
    chatter: str  # lines that tell progress and judge nothing
    echo: str  # lines that repeat the scene: they say nothing about it
    planted: list = field(default_factory=list)
    unsayable: list = field(default_factory=list)


def installed(snell):
    """The renderers of this machine, Snell first; says which are missing."""
    beside = str(Path(sys.executable).parent)
    path = os.pathsep.join([beside, os.environ.get("PATH", "")])
    povray, mitsuba = shutil.which("povray"), shutil.which("mitsuba", path=path)
    luxcore = [sys.executable, "render.py"] if importlib.util.find_spec("pyluxcore") else None
    found = [
        Renderer(
            name="Snell", folder="snell", command=[snell, "render", "good.snell", "-o", "good.png"],
            version=version([snell, "--version"]),
            place=r"╭─\[(?P<file>[^:\]]+):(?P<line>\d+):(?P<column>\d+)\]",
            chatter=r"^(good\.snell → |  (method|passes|time|rays|error) )|^\d+ (error|warning)s?\b",
            echo=r"^ *\d+ │ ",
        ),
        povray and Renderer(
            name="POV-Ray", folder="povray", command=[povray, "good.pov", "+Ogood.png", "+W8", "+H8", "-D", "-GS", "-GR"],
            version=version([povray, "--version"]),
            place=r"File '(?P<file>[^']+)' line (?P<line>\d+)",
            chatter=r"^(=+ \[|Rendered |POV-Ray finished)", echo=r"(?!)",
        ),
        mitsuba and Renderer(
            name="Mitsuba", folder="mitsuba", command=[mitsuba, "-m", "scalar_rgb", "good.xml"],
            version=version([mitsuba, "--help"]),
            place=r'(?P<file>[\w.]+\.xml)"?(?: failed: [^()]*)? \(line (?P<line>\d+), col (?P<column>\d+)\)',
            chatter=r"^[\d-]+ [\d:]+ INFO |^Rendering \[", echo=r"(?!)",
        ),
        luxcore and Renderer(
            name="LuxCore", folder="luxcore", command=[*luxcore, "good.cfg"],
            version=version([*luxcore, "--version"], HERE / "luxcore"),
            place=r"at line (?P<line>\d+)",
            chatter=r"^\[\w+\]\[[\d.]+\] (?!.*([Ww]arning|WARNING|[Ee]rror))", echo=r'^scene\.\S+ = "',
        ),
    ]
    for name, renderer in zip(["Snell", "POV-Ray", "Mitsuba", "LuxCore"], found):
        print(f"{name} {renderer.version}" if renderer else f"{name} is not installed and left out")
    return [with_mistakes(renderer) for renderer in found if renderer]


def version(command, folder=HERE):
    """The version that a command tells."""
    said = subprocess.run(command, cwd=folder, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True).stdout
    named = re.search(r"(?:snell|POV-Ray|Mitsuba version|LuxCore) ([0-9.]+)", said)
    return named[1].rstrip(".") if named else "of unknown version"


def with_mistakes(renderer):
    """The renderer with what is planted in its scenes, in the order of the kinds."""
    table = tomllib.loads((HERE / renderer.folder / "planted.toml").read_text())
    order = [kind["name"] for kind in KINDS]
    renderer.planted = sorted(table["planted"], key=lambda mistake: order.index(mistake["kind"]))
    renderer.unsayable = table.get("unsayable", [])
    told = [mistake["kind"] for mistake in renderer.planted] + renderer.unsayable
    assert sorted(told) == sorted(order), f"{renderer.name}: each kind once, planted or unsayable"
    return renderer


KINDS = tomllib.loads((HERE / "kinds.toml").read_text())["kind"]


# ── A run ────────────────────────────────────────────────────────────────────────────────────────────────────────────

# `texts` are the scene's files as they were rendered; `lines` is what the renderer printed.
Run = namedtuple("Run", "texts exit lines")


def run(renderer, mistakes):
    """Renders the good scene with these mistakes planted."""
    with tempfile.TemporaryDirectory() as scratch:
        folder = Path(scratch) / renderer.folder
        write_scene(renderer, mistakes, folder)
        texts = {path.name: path.read_text() for path in folder.iterdir() if path.suffix != ".png"}
        try:
            done = subprocess.run(
                renderer.command, cwd=folder, stdin=subprocess.DEVNULL, stdout=subprocess.PIPE, stderr=subprocess.STDOUT,
                timeout=SECONDS,
            )
            code, output = done.returncode, done.stdout.decode(errors="replace")
        except subprocess.TimeoutExpired as late:
            code, output = f"none within {SECONDS} s", (late.stdout or b"").decode(errors="replace")
    output = re.sub(r"\x1b\[[\d;]*m", "", output).replace(f"{folder}/", "")
    return Run(texts, code, [line.rstrip() for line in output.replace("\r", "\n").splitlines()])


def write_scene(renderer, mistakes, folder):
    """Copies the good scene and plants the mistakes in the copy."""
    shutil.copytree(HERE / renderer.folder, folder)
    for mistake in mistakes:
        plant(folder / mistake["file"], mistake)


def write_scenes(renderer, folder):
    """Writes the scene of every mistake alone, and of all at once."""
    sets = {mistake["kind"]: [mistake] for mistake in renderer.planted} | {"all": renderer.planted}
    for name, mistakes in sets.items():
        write_scene(renderer, mistakes, folder / renderer.folder / name)


def plant(path, mistake):
    """Turns the one `old` of a file into `new`."""
    text = path.read_text()
    assert text.count(mistake["old"]) == 1, f"{path.name} holds `{mistake['old']}` {text.count(mistake['old'])} times"
    path.write_text(text.replace(mistake["old"], mistake["new"]))


def news(renderer, good, bad):
    """What a run printed that the good scene's run did not, without what tells progress; numbers are not compared."""
    known = {re.sub(r"[\d.]+", "#", line) for line in good.lines}
    fresh = [line for line in bad.lines if re.sub(r"[\d.]+", "#", line) not in known]
    return [line for line in fresh if not re.search(renderer.chatter, line)]


# ── Judging ──────────────────────────────────────────────────────────────────────────────────────────────────────────

Verdict = namedtuple("Verdict", "reported line column near cured")
SILENT = Verdict(False, False, False, False, False)


def judge(renderer, mistake, good, bad, alone):
    """What a run says about one planted mistake. Alone in the scene, whatever is new concerns it."""
    said = " ".join(" ".join(line for line in news(renderer, good, bad) if not re.search(renderer.echo, line)).split())
    planted_at = re.escape(mistake.get("at", mistake["new"]) or "(?!)")
    places = [match.groupdict() for match in re.finditer(renderer.place, said)]
    line = any(on_line(place, mistake, bad.texts) for place in places)
    recognised = line or bool(re.search(mistake.get("says", planted_at), said))
    reported = bool(said) or bad.exit != good.exit if alone else recognised
    if not reported:
        return SILENT
    if not recognised:
        print(f"{renderer.name}, {mistake['kind']}: look whether this concerns it: {said[:200]}", file=sys.stderr)
    column = any(in_column(place, mistake, bad.texts) for place in places)
    near = any(is_near(place, mistake, bad.texts) for place in places)
    named = bool(re.search(mistake.get("names", planted_at), said))
    return Verdict(True, line, column, near or named, bool(re.search(mistake["cure"], said)))


def on_line(place, mistake, texts):
    """Whether a place is on a line of the mistake."""
    return int(place["line"]) in lines_of(place, mistake, texts, ["new", "also"])


def is_near(place, mistake, texts):
    """Whether a place is next to the mistake, or at the head of the block around it."""
    beside = {line + step for line in lines_of(place, mistake, texts, ["new", "also"]) for step in (-1, 1)}
    return int(place["line"]) in beside | lines_of(place, mistake, texts, ["around"])


def lines_of(place, mistake, texts, keys):
    """The lines on which the texts of a mistake stand, in the file of a place."""
    lines = set()
    for file, start, end in spans(place, mistake, texts, keys):
        lines |= set(range(texts[file].count("\n", 0, start) + 1, texts[file].count("\n", 0, end) + 2))
    return lines


def in_column(place, mistake, texts):
    """Whether a place gives a column within the planted words."""
    if not place.get("column"):
        return False
    for file, start, end in spans(place, mistake, texts, ["at" if "at" in mistake else "new", "also"]):
        before = texts[file].split("\n")[: int(place["line"]) - 1]
        if start <= sum(len(line) + 1 for line in before) + int(place["column"]) - 1 <= end:
            return True
    return False


def spans(place, mistake, texts, keys):
    """Where texts of a mistake stand: file, first and last character. A place without a file is in the mistake's."""
    for key in keys:
        if not mistake.get(key):
            continue
        for file in [mistake["file"]] if key != "also" else texts:
            start = texts[file].find(mistake["new"]) if key in ("new", "at") else 0
            start = texts[file].find(mistake[key], start) if start >= 0 else -1
            if start >= 0 and place.get("file", file) == file:
                yield file, start, start + len(mistake[key].rstrip("\n"))


# ── Measuring ────────────────────────────────────────────────────────────────────────────────────────────────────────


@dataclass
class Result:
    """All that was measured of one renderer."""

    renderer: Renderer
    good: Run
    alone: dict = field(default_factory=dict)  # kind → (run, verdict)
    rounds: list = field(default_factory=list)  # (run, kinds that it reports), the first with all mistakes at once


def measure(renderer):
    """Renders the good scene, each mistake alone, and all at once: then again without what was reported, until silence."""
    good = run(renderer, [])
    assert good.exit == 0, f"{renderer.name} must render its good scene:\n" + "\n".join(good.lines)
    result = Result(renderer, good)
    for mistake in renderer.planted:
        bad = run(renderer, [mistake])
        result.alone[mistake["kind"]] = bad, judge(renderer, mistake, good, bad, alone=True)
    left = renderer.planted
    while left:
        bad = run(renderer, left)
        told = [mistake for mistake in left if judge(renderer, mistake, good, bad, alone=len(left) == 1).reported]
        if not told:
            assert bad.exit == good.exit, f"{renderer.name} stops at something:\n" + "\n".join(bad.lines)
            break
        result.rounds.append((bad, [mistake["kind"] for mistake in told]))
        left = [mistake for mistake in left if mistake not in told]
    return result


# ── The page ─────────────────────────────────────────────────────────────────────────────────────────────────────────

INTRO = """# The same mistakes, given to {renderers}

What a renderer says about a broken scene decides how long the scene stays broken. Here {count} kinds of mistakes are planted,
one at a time and then all at once, in the same small still life written in the language of each renderer, and everything
that each prints is held against what was planted. This page is written by

```sh
python3 benches/mistakes/compare.py
```
"""

METHOD = """## How it was measured

Every renderer has a good scene of its own: three marbles, a tent from a mesh, a floor with a picture on it and a lamp, in two
files where the language has includes. `planted.toml` beside it holds the mistakes
as changes of text, so a bad scene differs from the good one in one place. Every scene is rendered, 8 × 8 pixels and one
sample each, so that a mistake may also be found while the scene is built or rendered.

Each output is judged by rules in `compare.py`, the same for all:

- **Reported**: the exit code differs, or something is printed that the good scene's run does not print, but for progress
  and repeats of the scene. Warnings count.
- **Line**: file and line of the mistake are given, or for what is left out those of where it belongs or of what it should close.
  A language whose scene is one file need not name it.
- **Column**: a column within the planted words is given; for Mitsuba, which counts tags, within their tag.
- **Near**: no right line, but the line next to it, or the head of the block around it, or a name by which a search finds
  the place.
- **Cured**: the report says what to write, by the rule of its kind, below.
- **First run**: in the scene with all mistakes at once, those that are told in one run.
- **Runs**: what is told is mended and the scene rendered again, until nothing more is told: that many runs tell everything that
  the renderer knows to tell.

| kind | planted | cured if the report |
|---|---|---|
{kinds}

{unsayable}

Not everything under sense is a slip everywhere: an index of refraction below 1 can be meant as a ratio, a negative radius turns
a sphere of Mitsuba's inside out, POV-Ray lets a surface be as bright as one likes, and libraries of materials hold much that
no scene uses. It is counted all the same, and apart from the mistakes of form. A second `#declare` of a name is an assignment
in POV-Ray, so its scene has a second camera instead. Commas are optional in POV-Ray and Mitsuba and unknown in LuxCore, so an
equals sign is left out there. Mitsuba places what a plugin finds at the head of the plugin's tag, which here counts as near.

Snell's authors chose the mistakes, wrote the scenes and made the rules; whoever knows a renderer better may read the scenes in
`benches/mistakes/` and say what is unfair.

### Versions

{versions}

`apt-get install povray` and `pip install mitsuba pyluxcore` gave the newest of each that these registries had; pbrt has no
package in them. LuxCore's console stops with a `TypeError` before it renders in this version, so
`benches/mistakes/luxcore/render.py` calls the same library. A renderer that is not installed is left out of the page.
"""

PRAISE = {
    "POV-Ray": "Names what it found and what it had expected (`Expected 4 parameters but only 3 found`), always with file and "
    "line, also in includes. It goes on where it can: a scale of 0 and a second camera are warnings that say what it does instead.",
    "Mitsuba": "Names file, line and column of the tag, in includes too, and for a name defined twice the place of the first. "
    "Fields that no plugin asked for are errors. Messages of its plugins list the words that may stand (`must be one of: "
    "\"repeat\", \"mirror\", or \"clamp\"`) and the range of a reflectance, and a type error says what was expected and what was found.",
    "LuxCore": "Names the property or object in most of its reports, which in a language of one property a line is nearly a place; "
    "a wrong number of values and a singular matrix are found.",
}


def page(results):
    """The whole page."""
    renderers = [result.renderer for result in results]
    mute = {kind["name"]: [each.name for each in renderers if kind["name"] in each.unsayable] for kind in KINDS}
    gaps = "; ".join(f"{kind} ({', '.join(names)})" for kind, names in mute.items() if names) or "none"
    method = METHOD.format(
        kinds="\n".join(f"| {kind['name']} | {kind['planted']} | {kind['cured']} |" for kind in KINDS),
        unsayable=f"A kind that a language cannot say is left out of its count: {gaps}.",
        versions="\n".join(f"- {each.name} {each.version}" for each in renderers),
    )
    intro = INTRO.format(count=len(KINDS), renderers=", ".join(each.name for each in renderers))
    parts = [intro, summary(results), findings(results), by_kind(results), praise(results), method]
    return "\n".join(parts + ["## What they said\n"] + [outputs(result) for result in results])


def summary(results):
    """The table of one line a renderer."""
    rows = ["| renderer | planted | reported | line | column | near only | cured | first run | runs |"]
    rows.append("|---" + "|--:" * 8 + "|")
    for result in results:
        verdicts = [verdict for _, verdict in result.alone.values()]
        near_only = sum(verdict.near and not verdict.line for verdict in verdicts)
        cells = [
            f"{result.renderer.name} {result.renderer.version}", len(verdicts), sum(verdict.reported for verdict in verdicts),
            sum(verdict.line for verdict in verdicts), sum(verdict.column for verdict in verdicts), near_only,
            sum(verdict.cured for verdict in verdicts), f"{len(result.rounds[0][1])} of {len(verdicts)}", len(result.rounds),
        ]
        rows.append(f"| {' | '.join(map(str, cells))} |")
    return "\n".join(rows) + "\n"


def findings(results):
    """Form and sense apart, and what Snell lacks."""
    lines = ["Mistakes of form (a parser or a type can know them) and of sense (only the meaning tells), reported of planted:\n"]
    lines += ["| renderer | form | sense |", "|---|--:|--:|"]
    for result in results:
        shares = []
        for group in ("form", "sense"):
            kinds = [kind["name"] for kind in KINDS if kind["group"] == group and kind["name"] in result.alone]
            shares.append(f"{sum(result.alone[kind][1].reported for kind in kinds)} of {len(kinds)}")
        lines.append(f"| {result.renderer.name} | {shares[0]} | {shares[1]} |")
    return "\n".join(lines + ["", *lacking(results[0]), *outdone(results), ""])


def lacking(snell):
    """Sentences about what Snell itself misses."""
    silent = [kind for kind, (_, verdict) in snell.alone.items() if not verdict.reported]
    astray = [kind for kind, (_, verdict) in snell.alone.items() if verdict.reported and not verdict.line]
    without = [kind for kind, (_, verdict) in snell.alone.items() if verdict.reported and verdict.line and not verdict.column]
    uncured = [kind for kind, (_, verdict) in snell.alone.items() if verdict.reported and not verdict.cured]
    late = [kind for kind in snell.alone if kind not in snell.rounds[0][1]]
    said = [("says nothing about", silent), ("gives no right line for", astray), ("gives no right column for", without)]
    said += [("gives no cure for", uncured), ("tells only in a later run, when all are planted at once,", late)]
    return [f"- Snell {words} {', '.join(kinds)}." for words, kinds in said if kinds]


def outdone(results):
    """Sentences about where another renderer does better than Snell."""
    lines = []
    for other in results[1:]:
        for kind, (_, verdict) in other.alone.items():
            snell = results[0].alone[kind][1]
            better = [name for name in Verdict._fields if name != "near" and getattr(verdict, name) and not getattr(snell, name)]
            if better:
                lines.append(f"- {other.renderer.name} does better than Snell in {kind}: {', '.join(better)}.")
    return lines or ["- In no kind is another renderer better than Snell by these rules."] * (1 < len(results))


def by_kind(results):
    """The table of one line a kind."""
    rows = ["## Kind by kind\n", f"| planted | {' | '.join(result.renderer.name for result in results)} |"]
    rows.append("|---" * (len(results) + 1) + "|")
    for kind in KINDS:
        cells = [cell(result, kind["name"]) for result in results]
        rows.append(f"| {kind['name']}: {kind['planted']} | {' | '.join(cells)} |")
    return "\n".join(rows) + "\n"


def cell(result, kind):
    """One verdict in a few words."""
    if kind not in result.alone:
        return "cannot be said"
    verdict = result.alone[kind][1]
    if not verdict.reported:
        return "–"
    place = "line, column" if verdict.column else "line" if verdict.line else "near" if verdict.near else "reported"
    return f"{place}, **cure**" if verdict.cured else place


def praise(results):
    """What the others do well."""
    lines = [f"- **{name}.** {words}" for name, words in PRAISE.items() if name in [result.renderer.name for result in results]]
    return "\n".join(["## What the others do well\n", *lines, ""])


def outputs(result):
    """What a renderer printed, trimmed, folded away."""
    name = result.renderer.name
    parts = [f"<details><summary>{name}, each mistake alone</summary>\n"]
    for mistake in result.renderer.planted:
        bad, _ = result.alone[mistake["kind"]]
        change = changed(result.good.texts[mistake["file"]], bad.texts[mistake["file"]])
        parts.append(f"**{mistake['kind']}** in `{mistake['file']}`: {cell(result, mistake['kind'])}\n\n```diff\n{change}\n```\n")
        parts.append(quoted(result, bad, 24))
    parts.append(f"</details>\n\n<details><summary>{name}, all at once, first run of {len(result.rounds)}</summary>\n")
    parts.append(f"Tells of: {', '.join(result.rounds[0][1])}.\n")
    parts.append(quoted(result, result.rounds[0][0], 400))
    parts.append("</details>\n")
    return "\n".join(parts)


def changed(good, bad):
    """The lines in which a bad text differs from the good one."""
    lines = difflib.unified_diff(good.split("\n"), bad.split("\n"), n=0, lineterm="")
    return "\n".join(line for line in lines if not re.match(r"---|\+\+\+|@@", line))


def quoted(result, bad, most):
    """What a run printed beyond the good one, at most so many lines."""
    wrap = textwrap.TextWrapper(120, drop_whitespace=False).wrap
    lines = [piece.rstrip() for line in news(result.renderer, result.good, bad) for piece in wrap(line)]
    if not lines:
        return f"Nothing new; exit code {bad.exit}.\n"
    cut = [f"… ({len(lines) - most} more lines)"] if len(lines) > most else []
    return "```text\n" + "\n".join(lines[:most] + cut) + f"\n```\n\nExit code {bad.exit}.\n"


def main():
    """Measures what is installed and writes the page."""
    parser = argparse.ArgumentParser(description=__doc__.split("\n")[0])
    parser.add_argument("--snell", default=str(ROOT / "target" / "release" / "snell"), help="the program to measure")
    parser.add_argument("-o", "--output", type=Path, default=ROOT / "docs" / "mistakes.md", help="where the page goes")
    parser.add_argument("--scenes", type=Path, help="a new folder to write the broken scenes to")
    given = parser.parse_args()
    snell = shutil.which(given.snell)
    if not snell:
        sys.exit(f"there is no `{given.snell}`: build it with `cargo build --release`, or name it with --snell")
    renderers = installed(str(Path(snell).resolve()))
    for renderer in renderers if given.scenes else []:
        write_scenes(renderer, given.scenes)
    results = [measure(renderer) for renderer in renderers]
    given.output.write_text(page(results))
    print(f"{given.output} is written")


if __name__ == "__main__":
    main()
