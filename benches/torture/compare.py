"""The room of scenes/torture/place.snell at many places and sizes, by three renderers, each in its own language.

    pip install mitsuba pillow; apt install povray
    python benches/torture/compare.py --snell target/release/snell --out docs

Writes docs/torture.jpg, a contact sheet, and docs/torture.md, a table: how much brighter or darker each picture is than the
same renderer's picture at the origin in metres, and how far two seeds of it differ there, which is noise. Then
docs/torture-scenes.jpg, what Snell makes of every scene in scenes/torture.
"""

import argparse
import pathlib
import subprocess
import tempfile

import mitsuba as mi
import numpy
from PIL import Image, ImageDraw

SIZE = (96, 72)
SAMPLES = 64
PLACES = [(away, 1.0) for away in (1e2, 1e3, 1e4, 1e5, 1e6, 1e7)]
SIZES = [(0, size) for size in (1e-6, 1e-5, 1e-4, 1e-3, 1e-2, 1e2, 1e4, 1e6)]
SCENES = pathlib.Path(__file__).resolve().parents[2] / "scenes" / "torture"


def linear(color):
    """A colour of the scene's texts as linear light."""
    shares = [int(color[i : i + 2], 16) / 255 for i in (1, 3, 5)]
    return [s / 12.92 if s <= 0.04045 else ((s + 0.055) / 1.055) ** 2.4 for s in shares]


FLOOR, WALL, BALL, BLOCK = (linear(c) for c in ("#bbbbbb", "#bb8866", "#6688bb", "#bbbbbb"))


def by_snell(program, folder, away, size, seed):
    picture = folder / "snell.exr"
    sets = ["--set", f"away={away!r}", "--set", f"size={size!r}"]
    film = ["--size", "%dx%d" % SIZE, "--passes", str(SAMPLES), "--seed", str(seed)]
    scene = str(SCENES / "place.snell")
    subprocess.run([program, "render", scene, *sets, *film, "-q", "-o", str(picture)], check=True)
    bitmap = mi.Bitmap(str(picture))
    names = [field.name for field in bitmap.struct_()]
    return numpy.array(bitmap)[..., [names.index(channel) for channel in "RGB"]].astype(float)


def by_mitsuba(_, folder, away, size, seed):
    T = mi.ScalarTransform4f
    at = numpy.array([away, -away, away]) * size
    place = lambda x, y, z: list(at + numpy.array([x, y, z]) * size)
    matt = lambda color: {"type": "diffuse", "reflectance": {"type": "rgb", "value": color}}

    def quad(origin, u, v, **more):
        middle = [o + (a + b) / 2 for o, a, b in zip(origin, u, v)]
        n = numpy.cross(u, v)
        n = n / numpy.linalg.norm(n) * size
        columns = [list(numpy.array(u) * size / 2), list(numpy.array(v) * size / 2), list(n), place(*middle)]
        matrix = [[columns[j][i] for j in range(4)] for i in range(3)] + [[0, 0, 0, 1]]
        return {"type": "rectangle", "to_world": T(matrix), **more}

    lamp = {"type": "area", "radiance": {"type": "rgb", "value": [12.0] * 3}}
    scene = mi.load_dict({
        "type": "scene",
        "integrator": {"type": "path", "max_depth": 6},
        "sensor": {
            "type": "perspective",
            "fov": 40, "fov_axis": "y",
            "near_clip": 0.01 * size, "far_clip": 100 * size,
            "to_world": T().look_at(origin=place(0, 1.2, 4), target=place(0, 0.8, 0), up=[0, 1, 0]),
            "film": {"type": "hdrfilm", "width": SIZE[0], "height": SIZE[1], "rfilter": {"type": "box"}},
            "sampler": {"type": "independent", "sample_count": SAMPLES, "seed": seed},
        },
        "lamp": quad((-0.5, 2.8, -0.5), (1, 0, 0), (0, 0, 1), emitter=lamp),
        "floor": quad((-3, 0, 3), (6, 0, 0), (0, 0, -6), bsdf=matt(FLOOR)),
        "wall": quad((-3, 0, -2), (6, 0, 0), (0, 4, 0), bsdf=matt(WALL)),
        "ball": {"type": "sphere", "center": place(-0.7, 0.5, 0), "radius": 0.5 * size, "bsdf": matt(BALL)},
        "block": {
            "type": "cube",
            "to_world": T().translate(place(0.6, 0.4, 0)) @ T().scale([0.4 * size] * 3),
            "bsdf": matt(BLOCK),
        },
    })
    return numpy.array(mi.render(scene, spp=SAMPLES, seed=seed))


def by_povray(program, folder, away, size, seed):
    at = numpy.array([away, -away, away]) * size

    def place(x, y, z):  # left-handed: z turned about
        p = at + numpy.array([x, y, z]) * size
        return "<%r, %r, %r>" % (float(p[0]), float(p[1]), float(-p[2]))

    matt = lambda c: "texture { pigment { rgb <%r, %r, %r> } finish { ambient 0 diffuse 1 } }" % tuple(c)

    def quad(origin, u, v, color):
        o, a, b = (numpy.array(x, float) for x in (origin, u, v))
        p, q, r, s = (place(*x) for x in (o, o + a, o + a + b, o + b))
        return f"polygon {{ 5, {p}, {q}, {r}, {s}, {p} {matt(color)} }}"

    text = "\n".join([
        "#version 3.7; global_settings { assumed_gamma 1 max_trace_level 6 }",
        f"camera {{ perspective location {place(0, 1.2, 4)} right x*4/3 angle 51.78 look_at {place(0, 0.8, 0)} }}",
        f"light_source {{ {place(0, 2.8, 0)} rgb 1.2 area_light <{size!r}, 0, 0>, <0, 0, {size!r}>, 8, 8 jitter }}",
        quad((-3, 0, 3), (6, 0, 0), (0, 0, -6), FLOOR),
        quad((-3, 0, -2), (6, 0, 0), (0, 4, 0), WALL),
        f"sphere {{ {place(-0.7, 0.5, 0)}, {0.5 * size!r} {matt(BALL)} }}",
        f"box {{ {place(0.2, 0, 0.4)}, {place(1, 0.8, -0.4)} {matt(BLOCK)} }}",
    ])
    (folder / "room.pov").write_text(text)
    run = [program, "room.pov", "-D", "+A0.0", "+AM1", "+R3", "+W%d" % SIZE[0], "+H%d" % SIZE[1], "+FP16", "+Oroom.ppm", "File_Gamma=1"]
    subprocess.run(run, cwd=folder, check=True, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
    header, rest = b"", (folder / "room.ppm").read_bytes()
    while header.count(b"\n") < 3:
        line, rest = rest.split(b"\n", 1)
        header += b"" if line.startswith(b"#") else line + b"\n"
    deep = int(header.split()[-1]) > 255
    values = numpy.frombuffer(rest, ">u2" if deep else "u1").astype(float) / (65535 if deep else 255)
    return values.reshape(SIZE[1], SIZE[0], 3)


def display(picture, exposure):
    x = numpy.clip(numpy.nan_to_num(picture) * exposure, 0, 1)
    x = numpy.where(x <= 0.0031308, 12.92 * x, 1.055 * x ** (1 / 2.4) - 0.055)
    return Image.fromarray((x * 255 + 0.5).astype("uint8"))


def scenes_sheet(program, folder):
    """Every scene of the folder, by Snell, with its name."""
    scenes = sorted(SCENES.glob("*.snell"))
    columns, (width, height) = 4, (240, 180)
    rows = -(-len(scenes) // columns)
    sheet = Image.new("RGB", (width * columns, (height + 14) * rows))
    draw, picture = ImageDraw.Draw(sheet), folder / "scene.png"
    for i, scene in enumerate(scenes):
        film = ["--size", f"{width}x{height}", "--passes", str(SAMPLES)]
        subprocess.run([program, "render", str(scene), *film, "-q", "-o", str(picture)], check=True)
        x, y = i % columns * width, i // columns * (height + 14)
        sheet.paste(Image.open(picture), (x, y + 14))
        draw.text((x + 2, y + 1), scene.stem, fill="white")
    return sheet


def percent(picture, base):
    ratio = picture.mean() / base.mean() - 1
    if not numpy.isfinite(ratio):
        return "not a number"
    return "same" if ratio == 0 else f"{ratio * 100:+.2f} %"


def main():
    parser = argparse.ArgumentParser()
    parser.add_argument("--snell", default="target/release/snell")
    parser.add_argument("--povray", default="povray")
    parser.add_argument("--out", type=pathlib.Path, default=pathlib.Path("docs"))
    options = parser.parse_args()
    mi.set_variant("scalar_rgb")
    renderers = [
        ("Snell", by_snell, str(pathlib.Path(options.snell).resolve())),
        ("Mitsuba 3 (" + mi.__version__ + ")", by_mitsuba, ""),
        ("POV-Ray 3.7", by_povray, options.povray),
    ]
    steps = [("away", *step) for step in PLACES] + [("size", *step) for step in SIZES]
    shown = [(0, 1.0), (1e4, 1.0), (1e5, 1.0), (1e6, 1.0), (0, 1e-6), (0, 1e-4), (0, 1e6)]
    sheet = Image.new("RGB", (SIZE[0] * len(shown), (SIZE[1] + 14) * len(renderers)))
    rows, draw = {}, ImageDraw.Draw(sheet)
    with tempfile.TemporaryDirectory() as name:
        folder = pathlib.Path(name)
        for row, (title, render, program) in enumerate(renderers):
            base = render(program, folder, 0, 1.0, 1)
            other = render(program, folder, 0, 1.0, 2)
            rows[title] = [percent(other, base)]
            exposure = 0.35 / base.mean()

            def show(picture, step):
                x, y = shown.index(step) * SIZE[0], row * (SIZE[1] + 14)
                sheet.paste(display(picture, exposure), (x, y + 14))
                away, size = step
                label = f"at {away:.0e}" if away else f"x {size:.0e}" if size != 1 else ""
                draw.text((x + 2, y + 1), f"{title.split()[0]} {label}", fill="white")

            show(base, (0, 1.0))
            for kind, away, size in steps:
                try:
                    picture = render(program, folder, away, size, 1)
                    rows[title].append(percent(picture, base))
                except (RuntimeError, subprocess.CalledProcessError):
                    picture = numpy.zeros_like(base)
                    rows[title].append("refused")
                print(title, kind, away, size, rows[title][-1], flush=True)
                if (away, size) in shown:
                    show(picture, (away, size))
        scenes_sheet(renderers[0][2], folder).save(options.out / "torture-scenes.jpg", quality=85)
    sheet.resize((sheet.width * 2, sheet.height * 2)).save(options.out / "torture.jpg", quality=85)
    head = "| where | " + " | ".join(rows) + " |\n|---|" + "---:|" * len(rows) + "\n"
    names = ["at the origin in metres, another seed"]
    names += [f"{away:.0e} sizes away" if kind == "away" else f"{size:.0e} m large" for kind, away, size in steps]
    lines = [f"| {name} | " + " | ".join(rows[t][i] for t in rows) + " |" for i, name in enumerate(names)]
    (options.out / "torture.md").write_text(PREAMBLE + head + "\n".join(lines) + "\n")


PREAMBLE = """# Far away, tiny and huge

The room of `scenes/torture/place.snell`, moved along all three axes and made larger and smaller: how much brighter or darker
each picture is than that of the same renderer at the origin in metres. Each renderer has the scene in its own language, and
its own settings but for the number of samples (%d; POV-Ray: 9 with 64 of its lamp, and no light between surfaces).

```sh
pip install mitsuba pillow; apt install povray
python benches/torture/compare.py
```

![the room by three renderers](torture.jpg)

The other scenes of `scenes/torture` say in their first lines what is hard about them:

![every scene of the folder, by Snell](torture-scenes.jpg)

""" % SAMPLES

if __name__ == "__main__":
    main()
