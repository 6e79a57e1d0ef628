#!/usr/bin/env python3
"""Names, files and codecs that a stranger may bring, through every command that takes them.

    tests/strange_inputs.py STRIDE [--quick] [--verbose]

Names: each command does its work, writes what it should under that name and nothing else, and runs
nothing. Files of another kind: exit 1 or 2, one sentence that begins with "error:", names the file
and is no parser's talk; nothing is written. The same for files of ours with values that no video,
runner or person has, and for options that are empty or have no effect. Codecs, turned pictures, odd
sizes, uneven times (needs ffmpeg): as many frames as were coded, the left knee in its place, and
what is odd is told.
--quick takes one name of every odd sign, a seventh of the wrong files, every second of what is no file, and no codecs.
"""
import argparse, hashlib, json, math, os, pathlib, shutil, subprocess, sys, tempfile, zipfile

SOURCE = pathlib.Path(__file__).resolve().parents[1]
NAMES = ["a b  c", "-o", "über 走る 🏃", "it's \"quoted\"", "`touch RAN`", "$(touch RAN)", "%d %s%n", "a;touch RAN;b",
         "[x]{y}(z)", "#1 & <b>&amp;", "line\nbreak", "a.trajectory", "a.keypoints", "..dots..", "back\\slash",
         "10:30", "http:x", "a=b,c", "_sub_^sup", "''", "it''s", "%04d", ".hidden", "~", "*", "tab\there", "x" * 180, "caf\udce9"]  # the last one in Latin-1
QUICK = "-`touch RAN`$(touch RAN)''\"%04d;&<b>\\_^ü走"
TALK = ["terminate called", "what():", "std::", "json.exception", "basic_string", "parse_error", "type_error", "stoi",
        "Assertion", "Sanitizer", "CLI::", "cv::", "OpenCV(", "[ERROR", "Traceback"]
CODECS = {"hevc.mp4": ["-c:v", "libx265", "-x265-params", "log-level=none"], "vp9.webm": ["-c:v", "libvpx-vp9", "-deadline", "realtime"],
          "ffv1.mkv": ["-c:v", "ffv1"], "theora.ogv": ["-c:v", "libtheora", "-q:v", "7"], "wmv2.wmv": ["-c:v", "wmv2", "-q:v", "4"],
          "huffyuv.avi": ["-c:v", "huffyuv"], "rawvideo.avi": ["-c:v", "rawvideo"], "mjpeg.mov": ["-c:v", "mjpeg", "-q:v", "3"],
          "h264_422.mov": ["-c:v", "libx264", "-pix_fmt", "yuv422p10le"], "mpeg1.mpg": ["-c:v", "mpeg1video", "-q:v", "4", "-r", "24"],
          "png.mov": ["-c:v", "png"], "flashsv.flv": ["-c:v", "flashsv"],
          "av1.webm": ["-c:v", "libaom-av1", "-cpu-used", "8", "-crf", "30"], "vp8.webm": ["-c:v", "libvpx", "-b:v", "1M", "-deadline", "realtime"],
          "prores.mov": ["-c:v", "prores_ks", "-profile:v", "1"], "xvid.avi": ["-c:v", "mpeg4", "-vtag", "XVID", "-q:v", "3"],
          "mjpeg.avi": ["-c:v", "mjpeg", "-q:v", "3"], "msmpeg4.avi": ["-c:v", "msmpeg4", "-q:v", "3"], "utvideo.avi": ["-c:v", "utvideo"],
          "dnxhr.mov": ["-c:v", "dnxhd", "-profile:v", "dnxhr_lb", "-pix_fmt", "yuv422p"], "jpeg2000.mov": ["-c:v", "jpeg2000"],
          "qtrle.mov": ["-c:v", "qtrle"], "mpeg2.ts": ["-c:v", "mpeg2video", "-q:v", "4"], "h263.mkv": ["-c:v", "flv1", "-q:v", "3"],
          "grey16.mkv": ["-c:v", "ffv1", "-pix_fmt", "gray16le"], "full_range.mp4": ["-c:v", "libx264", "-pix_fmt", "yuvj420p"],
          "yuv444.mp4": ["-c:v", "libx264", "-pix_fmt", "yuv444p"], "alpha.webm": ["-c:v", "libvpx-vp9", "-pix_fmt", "yuva420p", "-deadline", "realtime"],
          "stream.h264": ["-c:v", "libx264", "-f", "h264"], "stream.m4v": ["-c:v", "mpeg4", "-q:v", "3", "-f", "m4v"], "stream.y4m": ["-pix_fmt", "yuv420p"],
          "anim.gif": [], "anim.apng": ["-plays", "1"],
          "grey.mp4": ["-c:v", "libx264", "-pix_fmt", "gray"], "alpha.mov": ["-c:v", "prores_ks", "-profile:v", "4444", "-pix_fmt", "yuva444p10le"],
          # What phones, editors and screen recorders do: turned, odd sizes, uneven times, pixels that are not square, sound, a start that is not 0.
          **{f"turned{angle}.{kind}": ["-vf", how, "-c:v", "libx264"] for kind in ("mp4", "mov")
             for angle, how in ((90, "transpose=2"), (180, "hflip,vflip"), (270, "transpose=1"))},
          "odd.mkv": ["-vf", "pad=323:181", "-c:v", "ffv1"], "uneven.mkv": ["-vf", "setpts='PTS+0.3*mod(N,3)/24/TB'", "-vsync", "0", "-c:v", "libx264"],
          "late.mp4": ["-c:v", "libx264", "-output_ts_offset", "3.7"],
          "wide.mp4": ["-vf", "scale=240:180,setsar=4/3", "-c:v", "libx264", "-crf", "12"],
          "sound.mp4": ["-f", "lavfi", "-i", "sine=duration=6", "-c:v", "libx264", "-c:a", "aac"],
          "interlaced.ts": ["-vf", "setfield=tff", "-c:v", "mpeg2video", "-flags", "+ildct+ilme", "-q:v", "3"]}
faults, runs = [], 0


def stride(folder, *arguments, timeout=120):
    global runs
    runs += 1
    command = [options.stride, *map(str, arguments)]
    try:
        done = subprocess.run(command, cwd=folder, stdin=subprocess.DEVNULL, stdout=subprocess.PIPE, stderr=subprocess.STDOUT,
                              timeout=timeout)
        status, said = done.returncode, done.stdout.decode(errors="replace")
    except subprocess.TimeoutExpired:
        status, said = "hangs", ""
    if options.verbose:
        print(*map(printable, ("$ stride", *arguments)), "\n" + said[:600].rstrip(), f"\n[exit {status}]", flush=True)
    for talk in TALK:
        if talk in said:
            fault(arguments, f"says '{talk}'", said)
    return status, said


def fault(arguments, what, said=""):
    line = printable(f"FAULT: stride {' '.join(map(str, arguments))!r}: {what}")
    faults.append(line)
    print(line + ("\n  " + said.strip()[-400:].replace("\n", "\n  ") if said else ""), flush=True)


def printable(text):
    return str(text).encode(errors="replace").decode()


def sha(path):
    return hashlib.sha256(pathlib.Path(path).read_bytes()).hexdigest()


def clicked(video, source="small", width=320, height=180):
    """The clip's clicks beside a video, however it is coded."""
    clicks = json.loads((SOURCE / "videos" / f"{source}.keypoints.json").read_text())
    clicks["video"], clicks["video_sha256"] = printable(video.name), sha(video)
    clicks["width_px"], clicks["height_px"] = width, height
    file = video.with_suffix(".keypoints.json") if video.suffix else pathlib.Path(str(video) + ".keypoints.json")
    file.write_text(json.dumps(clicks))


def contents(folder):
    return {p.relative_to(folder) for p in pathlib.Path(folder).rglob("*") if p.is_file()}


def works(folder, made, *arguments):
    before = contents(folder)
    inputs = {p: sha(folder / p) for p in before}
    status, said = stride(folder, *arguments)
    if status != 0:
        return fault(arguments, f"exit {status}", said)
    after = contents(folder)
    for path in made:
        if pathlib.Path(path) not in after:
            fault(arguments, f"did not make {path!r}", said)
    extra = after - before - {pathlib.Path(p) for p in made}
    if extra:
        fault(arguments, f"made {sorted(map(str, extra))}", said)
    for path, old in inputs.items():
        if path not in after or (sha(folder / path) != old and str(path) not in made):
            fault(arguments, f"changed {path}", said)


def names(folder, all_names):
    for name in all_names:
        home = folder / "names"
        shutil.rmtree(home, ignore_errors=True)
        home.mkdir()
        video = home / f"{name}.mp4"
        shutil.copy(SOURCE / "videos/small.mp4", video)
        clicked(video)
        (home / "events.jsonl").write_text('{"key": "a"}\n{"key": "d"}\n')
        v, at = f"./{name}.mp4", name
        works(home, [f"{at}.trajectory.csv", f"{at}.overlay.mp4"], "track", v, "--overlay", f"./{at}.overlay.mp4")
        works(home, [f"{at}.calibrated.csv", f"{at}.report.txt", f"{at}.report.svg", f"{at}.fitted.csv"], "calibrate",
              f"./{at}.trajectory.csv", "--fitted", f"./{at}.fitted.csv")
        works(home, [], "annotate", v, "--script", "events.jsonl")
        for file in (".mp4", ".keypoints.json", ".trajectory.csv", ".calibrated.csv", ".report.txt"):
            works(home, [], "info", f"./{at}{file}")
        works(home, [f"out/{at}{e}" for e in (".trajectory.csv", ".calibrated.csv", ".report.txt", ".report.svg",
                                              ".potential.json", ".converted.json")], "convert", v, "-o", "out")
        works(home, [f"{at}.html"], "report", f"./{at}.trajectory.csv")
        refuses(home, "an input", f"./{at}.trajectory.csv", "report", f"./{at}.trajectory.csv", "-o", f"./{at}.trajectory.csv")
        run = f"run {at}"
        status, said = stride(home, "train", "--preset", "demo", "--potential", f"out/{at}.potential.json", "--out", run,
                              "--decisions", "40")
        if status != 0 or not (home / run / "config.toml").exists():
            fault(["train", name], f"exit {status}", said)
        if (home / "RAN").exists() or list(home.rglob("RAN")):
            fault([name], "a name was run as a command")


def wrong_files(folder):
    """Kinds of file by a name; the ending is given by the command."""
    f = folder / "wrong"
    f.mkdir(exist_ok=True)
    def write(name, data):
        (f / name).write_bytes(data if isinstance(data, bytes) else data.encode())
        return f / name
    made = {"empty": write("empty", b""), "one byte": write("byte", b"\xff"), "text": write("text", "hello\n" * 50),
            "binary": write("binary", bytes(range(256)) * 40), "NULs": write("nul", b"\0" * 4096),
            "html": write("html", "<!DOCTYPE html><html><body>404</body></html>"), "pdf": write("pdf", b"%PDF-1.4\n1 0 obj\n"),
            "jpeg": SOURCE / "extract/annotation/landmarks.jpg", "source code": SOURCE / "main.cpp",
            "csv of others": write("others", "time,speed\n0,1\n1,2\n"), "json list": write("list", "[1, 2, 3]"),
            "json deep": write("deep", "[" * 5000 + "]" * 5000), "json cut": write("cut", '{"format": "stride keypoints", "ver'),
            "a long line": write("long", "a," * 200000), "UTF-16": write("utf16", "frame,knee_r_x\n0,1\n".encode("utf-16")),
            "toml": SOURCE / "train/presets/demo.toml", "a model": SOURCE / "calibrate/models/gait9dof18musc.osim",
            "script": write("script", "#!/bin/sh\ntouch RAN\n"), "elf": write("elf", b"\x7fELF" + bytes(200))}
    with zipfile.ZipFile(f / "zip", "w") as z:
        z.writestr("a.csv", "1,2\n")
    made["zip"] = f / "zip"
    return made


def refuses(folder, what, file, *arguments, writes=None):
    before = contents(folder)
    status, said = stride(folder, *arguments)
    if status not in (1, 2):
        return fault([what, "as", *arguments], f"exit {status}", said)
    last = [line for line in said.strip().split("\n") if line.startswith("error:")]
    if not last:
        fault([what, "as", *arguments], "no line begins with 'error:'", said)
    elif os.fsencode(str(file)).decode(errors="replace") not in said:
        fault([what, "as", *arguments], f"does not name {file}", said)
    elif len(said) > 1500:
        fault([what, "as", *arguments], f"says {len(said)} letters", said)
    new = contents(folder) - before
    if new:
        fault([what, "as", *arguments], f"left {sorted(map(str, new))}", said)


def files(folder, human):
    home = folder / "files"
    home.mkdir()
    for name in ("small.mp4", "small.keypoints.json"):
        shutil.copy(SOURCE / "videos" / name, home)
    for what, data in list(wrong_files(folder).items())[::7 if options.quick else 1]:
        def as_(ending):
            target = home / f"wrong{ending}"
            if target.is_dir():
                target.rmdir()
            for old in home.glob("wrong.*"):
                old.unlink()
            shutil.copyfile(data, target)
            return f"wrong{ending}"
        refuses(home, what, v := as_(".mp4"), "track", v, "--keypoints", "small.keypoints.json")
        refuses(home, what, v, "convert", v, "-o", "out")
        if what not in ("jpeg",):  # a picture, which info tells, and a clip of one frame, which can be clicked
            refuses(home, what, v, "annotate", v, "--script", "none.jsonl")
            refuses(home, what, v, "info", v)
        refuses(home, what, v, "report", human, "--video", v)
        refuses(home, what, k := as_(".keypoints.json"), "track", "small.mp4", "--keypoints", k)
        refuses(home, what, k, "annotate", "small.mp4", "--keypoints", k, "--script", "none.jsonl")
        if what != "csv of others":
            refuses(home, what, i := as_(".dat"), "track", "small.mp4", "--import", i)
        refuses(home, what, t := as_(".trajectory.csv"), "calibrate", t)
        refuses(home, what, t, "convert", t, "-o", "out")
        refuses(home, what, t, "report", t)
        refuses(home, what, c := as_(".calibrated.csv"), "convert", c, "-o", "out")
        refuses(home, what, c, "train", "--potential", human.replace("trajectory.csv", "potential.json"), "--reference", c, "--out", "run")
        refuses(home, what, p := as_(".potential.json"), "train", "--potential", p, "--out", "run")
        refuses(home, what, p, "info", p)
        if what != "a model":
            refuses(home, what, m := as_(".osim"), "calibrate", human, "--model", m)
        refuses(home, what, o := as_(".onnx"), "track", "small.mp4", "--pose", o)
    step = 2 if options.quick else 1
    for k, what in enumerate(("a folder", "nothing", "a link to itself", "a device", "a pipe")):
        for ending, command in [(".mp4", ["track"]), (".mp4", ["convert", "-o", "out"]), (".mp4", ["info"]), (".mp4", ["annotate", "--script", "x"]),
                                (".trajectory.csv", ["calibrate"]), (".trajectory.csv", ["report"]),
                                (".potential.json", ["train", "--out", "run", "--potential"]),
                                (".csv", ["track", "small.mp4", "--import"])][k % step::step]:
            target = home / f"odd{ending}"
            for old in home.glob("odd.*"):
                old.rmdir() if old.is_dir() and not old.is_symlink() else old.unlink()
            if what == "a folder":
                target.mkdir()
            elif what == "a link to itself":
                target.symlink_to(target)
            elif what == "a device":
                target.symlink_to("/dev/null")
            elif what == "a pipe":
                os.mkfifo(target)
            refuses(home, what, target.name, *command, target.name)
    if (home / "RAN").exists():
        fault(["files"], "a file was run")


def rows(text, change):
    """A table of ours with its cells changed: change(row number, column names, cells)."""
    lines = text.split("\n")
    first = next(i for i, line in enumerate(lines) if not line.startswith("#"))
    names = lines[first].split(",")
    for i in range(first + 1, len(lines) - 1):
        lines[i] = ",".join(map(str, change(i - first - 1, names, lines[i].split(","))))
    return "\n".join(lines)


def cell(text, column, value, row=None):
    """With one cell, or one of each row, set to value or, if that is a number, multiplied by it."""
    def change(i, names, cells):
        k = names.index(column)
        if row in (None, i):
            cells[k] = value if isinstance(value, str) else float(cells[k] or 0) * value
        return cells
    return rows(text, change)


def poses(text, change):
    """A potential with each pose changed."""
    potential = json.loads(text)
    for keyframe in potential["keyframes"]:
        change(keyframe)
    return json.dumps(potential)


def scaled(keyframe, x, y):
    for key, value in keyframe.items():
        if key.endswith("_m") and isinstance(value, list):
            keyframe[key] = [value[0] * x, value[1] * y]


def spoilt(good):
    """What is wrong with a file of ours, its ending, its text; each is refused."""
    t, c, p = ((good / f"small{e}").read_text() for e in (".trajectory.csv", ".calibrated.csv", ".potential.json"))
    def swapped(k):
        k["knee_r_m"], k["foot_r_m"] = k["foot_r_m"], k["knee_r_m"]
    def turned(k):
        for part in ("knee_r_m", "foot_r_m", "knee_l_m", "foot_l_m"):
            k[part].reverse()
    lines = t.split("\n")
    made = [("times in ms", cell(t, "time_s", 1000.0)), ("a frame twice", "\n".join(lines[:20] + lines[19:])),
            ("times that go back", cell(t, "time_s", "0.1", 40)), ("a point at 1e300", cell(t, "knee_r_x", "1e300", 9)),
            ("a confidence of 7", cell(t, "knee_r_confidence", "7", 9)), ("half a frame", cell(t, "frame", "3.5", 3)),
            ("no frames", "\n".join(lines[:lines.index(next(l for l in lines if l.startswith("frame,"))) + 1]) + "\n"),
            ("a NUL", t.replace("0.25,", "0.2\0005,")), ("treadmill: maybe", t.replace("treadmill: false", "treadmill: maybe")),
            ("cut off", t[:-90]), ("unit: m", t.replace("unit: px", "unit: m"))]
    made = [(what, ".trajectory.csv", text) for what, text in made]
    made += [(what, ".calibrated.csv", text) for what, text in
             [("angles in degrees", cell(c, "hip_flexion_r", 57.3)), ("a pelvis at 951 m", cell(c, "pelvis_ty", 1000.0)),
              ("a stride of an hour", c.replace("# period_s: 0", "# period_s: 3600")), ("a speed of a car", c.replace("# speed_m_s: ", "# speed_m_s: 4")),
              ("a verdict that refuses", c.replace("# verdict: ok", "# verdict: refused: no")), ("rows backward", cell(c, "time_s", -1.0))]]
    made += [(what, ".potential.json", text) for what, text in
             [("knee and foot exchanged", poses(p, swapped)), ("x and y exchanged", poses(p, turned)), ("y downward", poses(p, lambda k: scaled(k, 1, -1))),
              ("half a runner", poses(p, lambda k: scaled(k, 0.5, 0.5))), ("cm", poses(p, lambda k: scaled(k, 100, 100))),
              ("NaN", p.replace('"phase": 0.125', '"phase": NaN')), ("1e999", p.replace('"weight": 1.0', '"weight": 1e999')),
              ("words after the end", p + "x"), ("a speed backward", p.replace('"speed_m_s": ', '"speed_m_s": -'))]]
    return made


def own(folder, good):
    home = folder / "own"
    home.mkdir()
    for name in ("small.mp4", "small.keypoints.json"):
        shutil.copy(SOURCE / "videos" / name, home)
    command = {".trajectory.csv": ["calibrate"], ".calibrated.csv": ["convert", "-o", "out"],
               ".potential.json": ["train", "--reference", good / "small.calibrated.csv", "--out", "run", "--decisions", "4", "--potential"]}
    for what, ending, text in spoilt(good)[::3 if options.quick else 1]:
        file = home / f"spoilt{ending}"
        file.write_text(text)
        refuses(home, what, file.name, *command[ending], file.name)
        file.unlink()
    t = (good / "small.trajectory.csv").read_text()
    german = "\n".join(line if line.startswith("#") else line.replace(",", ";").replace(".", ",") for line in t.split("\n"))
    for what, data in (("CRLF", t.replace("\n", "\r\n").encode()), ("CR", t.replace("\n", "\r").encode()), ("BOM", t.encode("utf-8-sig")),
                       ("UTF-16", t.encode("utf-16")), ("as a German Excel", german.encode())):
        if options.quick and what in ("CR", "BOM", "UTF-16"):
            continue
        (home / "other.trajectory.csv").write_bytes(data)
        status, said = stride(home, "calibrate", "other.trajectory.csv", "--no-picture", "-o", "other.calibrated.csv")
        if status != 0:
            fault([what], f"exit {status}", said)
        for old in home.glob("other.*"):
            old.unlink()
    track, run = ["track", "small.mp4"], ["convert", "small.mp4", "-o", "out"]
    for wrong, arguments in [("--import", [*track, "--import", ""]), ("--keypoints", [*track, "--keypoints", ""]), ("--out", [*track, "-o", ""]),
                             ("small.mp4", [*track, "small.mp4"]), ("--out", [*track, "-o", "a.csv", "-o", "b.csv"]), ("new/", [*track, "-o", "new/"]),
                             ("-o -", [*track, "-o", "-"]), (".avi", [*track, "--overlay", "new/a.avi"]), ("255 bytes", [*track, "-o", "x" * 251 + ".csv"]),
                             ("small.mp4", [*run, "./small.mp4"]), ("--person", [*track, "--person", "2"]), ("--person", [*run, "--person", "2"]),
                             ("--no-leg-repair", [*track, "--no-leg-repair"]), ("--score", [*track, "--score", "small.truth.csv", "-o", "a.csv"]),
                             ("empty", ["info", ""]), ("empty", ["report", ""]), ("--slow-motion", [*track, "--slow-motion", "1,5"])][::2 if options.quick else 1]:
        refuses(home, "options", wrong, *arguments)


def points(table):
    """The left knee of every row."""
    lines = [line.split(",") for line in table.read_text().split("\n") if line and not line.startswith("#")]
    x = lines[0].index("knee_l_x")
    return [tuple(map(float, row[x:x + 2])) for row in lines[1:]]


def codecs(folder):
    home = folder / "codecs"
    home.mkdir()
    (home / "events.jsonl").write_text('{"key": "a"}\n')
    for name, how in CODECS.items():
        if options.codec and options.codec not in name:
            continue
        video = home / name
        stored = home / f"stored{video.suffix}" if name.startswith("turned") else video
        made = subprocess.run(["ffmpeg", "-v", "error", "-y", "-i", SOURCE / "videos/small.mp4", *how, stored], capture_output=True)
        if made.returncode != 0:
            print(f"{name}: not coded here: {made.stderr.decode()[-200:].strip()}")
            continue
        if stored != video:
            subprocess.run(["ffmpeg", "-v", "error", "-y", "-i", stored, "-c", "copy", "-metadata:s:v", f"rotate={video.stem[6:]}", video], check=True)
            stored.unlink()
        clicked(video, width=323 if name == "odd.mkv" else 320, height=181 if name == "odd.mkv" else 180)
        stem = video.stem
        works(home, [f"{stem}.trajectory.csv"], "track", name)
        knee = points(home / f"{stem}.trajectory.csv")
        if len(knee) != 96:
            fault(["track", name], f"{len(knee)} frames, not 96")
        off = max(math.dist(a, b) for a, b in zip(knee, points(SOURCE / "videos/small.truth.csv")))
        if not off < 6:
            fault(["track", name], f"the left knee is as much as {off:.1f} px off")
        works(home, [], "annotate", name, "--script", "events.jsonl")
        status, said = stride(home, "info", name)
        if status != 0 or "96 frames" not in said:
            fault(["info", name], f"exit {status}, not 96 frames", said)
        for part, told in (("turned", "turn"), ("uneven", "the rate varies"), ("wide", "not square")):
            if (part in name or (part, name) == ("uneven", "anim.gif")) != (told in said.replace(name, "")):  # a GIF counts hundredths
                fault(["info", name], f"'{told}'", said)
        works(home, [f"{stem}.calibrated.csv", f"{stem}.report.txt", f"{stem}.report.svg", f"{stem}.fitted.mp4"], "calibrate",
              f"{stem}.trajectory.csv", "--overlay", f"{stem}.fitted.mp4")
        works(home, [f"out/{stem}{e}" for e in (".trajectory.csv", ".calibrated.csv", ".report.txt", ".report.svg", ".potential.json",
                                                ".converted.json")], "convert", name, "-o", "out")
        works(home, [f"{stem}.html"], "report", f"{stem}.trajectory.csv", "-o", f"{stem}.html")
        works(home, [f"{stem}.exported.csv", f"{stem}.seen.mp4"], "track", name, "--import", f"{stem}.trajectory.csv", "--export",
              f"{stem}.exported.csv", "--overlay", f"{stem}.seen.mp4")
        status, said = stride(home, "info", f"{stem}.seen.mp4")
        if "96 frames in 4" not in said and "96 frames in 3.9" not in said and stem not in ("uneven", "mpeg1"):
            fault(["track", name, "--overlay"], "does not last as long as the video", said)
        works(home, [f"{stem}.again.csv"], "track", name, "--prior", f"{stem}.trajectory.csv", "-o", f"{stem}.again.csv")
        shutil.rmtree(home / "out", ignore_errors=True)
        for old in home.glob(f"{stem}.*"):
            old.unlink()


def main():
    with tempfile.TemporaryDirectory() as name:
        folder = pathlib.Path(name)
        good = folder / "good"
        good.mkdir()
        for file in ("small.mp4", "small.keypoints.json"):
            shutil.copy(SOURCE / "videos" / file, good)
        status, said = stride(good, "convert", "small.mp4", "-o", ".")
        if status != 0:
            sys.exit(f"convert small.mp4: exit {status}\n{said}")
        if options.only in (None, "names"):
            names(folder, [QUICK] if options.quick else NAMES)
        if options.only in (None, "files"):
            files(folder, str(good / "small.trajectory.csv"))
        if options.only in (None, "own"):
            own(folder, good)
        if options.only in (None, "codecs") and not options.quick:
            codecs(folder)
    print(f"{runs} runs, {len(faults)} faults")
    sys.exit(1 if faults else 0)


parser = argparse.ArgumentParser()
parser.add_argument("stride", type=os.path.abspath)
parser.add_argument("--quick", action="store_true"), parser.add_argument("--verbose", action="store_true")
parser.add_argument("--only", choices=["names", "files", "own", "codecs"]), parser.add_argument("--codec", help="only those whose names hold this")
options = parser.parse_args()
main()
