#!/usr/bin/env python3
"""Runs `stride track` and `stride convert` on damaged videos: none may crash, hang or eat memory.

    tests/bench/soak_videos.py STRIDE [--count 200] [--first 0] [--seed 1] [--keep FOLDER]

STRIDE is best a build with the address sanitizer. Each video is videos/small.mp4, coded anew by
ffmpeg (which is needed) in one of several codecs and then damaged: cut off, bits flipped in its
header or anywhere, blocks missing or repeated, or its size changed in the middle. Exit status 1 if
a run ends by a signal or a sanitizer's report, or takes over 60 s of processor time (or 20 minutes
of a busy machine). --first skips the videos before it: a soak that was ended goes on.
"""
import argparse, collections, json, os, pathlib, random, resource, shutil, subprocess, sys, tempfile, threading

SOURCE = pathlib.Path(__file__).resolve().parents[2] / "videos"
CODECS = {
    "h264.mp4": ["-c:v", "libx264", "-crf", "26"],
    "bframes.mp4": ["-c:v", "libx264", "-bf", "3", "-g", "24", "-crf", "26"],
    "fragmented.mp4": ["-c:v", "libx264", "-crf", "26", "-movflags", "frag_keyframe+empty_moov"],
    "mjpeg.avi": ["-c:v", "mjpeg", "-q:v", "5"],
    "mpeg4.avi": ["-c:v", "mpeg4", "-q:v", "5"],
    "h264.mkv": ["-c:v", "libx264", "-crf", "26"],
    "vp8.webm": ["-c:v", "libvpx", "-b:v", "500k", "-deadline", "realtime"],
    "h264.ts": ["-c:v", "libx264", "-crf", "26"],
    "mpeg2.mpg": ["-c:v", "mpeg2video", "-q:v", "5"],
    "flv1.flv": ["-c:v", "flv1", "-q:v", "5"],
    "anim.gif": [],
    "prores.mov": ["-c:v", "prores_ks", "-profile:v", "0"],
}


def ffmpeg(*arguments):
    subprocess.run(["ffmpeg", "-v", "error", "-y", *map(str, arguments)], check=True)


def originals(folder):
    files = []
    for name, how in CODECS.items():
        ffmpeg("-i", SOURCE / "small.mp4", *how, folder / name)
        files.append(folder / name)
    ffmpeg("-i", SOURCE / "small.mp4", "-vf", "scale=160:90", "-c:v", "libx264", "-crf", "26", folder / "half.ts")
    whole, half = (folder / "h264.ts").read_bytes(), (folder / "half.ts").read_bytes()
    (folder / "resized.ts").write_bytes(whole[: len(whole) // 2] + half)  # its size changes in the middle
    files.append(folder / "resized.ts")
    return files


def damaged(data, rng):
    data = bytearray(data)
    kind = rng.choice(["cut", "header", "anywhere", "hole", "repeat", "zeros"])
    n = len(data)
    if kind == "cut":
        del data[rng.randrange(1, n):]
    elif kind == "header":
        for _ in range(rng.randrange(1, 20)):
            data[rng.randrange(min(n, 2000))] ^= 1 << rng.randrange(8)
    elif kind == "anywhere":
        for _ in range(rng.randrange(1, 200)):
            data[rng.randrange(n)] ^= 1 << rng.randrange(8)
    else:
        at, length = rng.randrange(n), rng.randrange(1, max(2, n // 10))
        if kind == "hole":
            del data[at:at + length]
        elif kind == "repeat":
            data[at:at] = data[at:at + length]
        else:
            data[at:at + length] = bytes(len(data[at:at + length]))
    return kind, bytes(data)


def run(command):
    """Exit status, seconds of processor time, greatest memory in MB, and what it said."""
    with tempfile.TemporaryFile() as said:
        process = subprocess.Popen(command, stdout=said, stderr=subprocess.STDOUT, stdin=subprocess.DEVNULL,
                                   preexec_fn=lambda: resource.setrlimit(resource.RLIMIT_CPU, (60, 60)))
        timer = threading.Timer(1200, process.kill)
        timer.start()
        _, status, used = os.wait4(process.pid, 0)
        timer.cancel()
        process.returncode = os.waitstatus_to_exitcode(status)
        said.seek(0)
        text = said.read().decode(errors="replace")
    return process.returncode, used.ru_utime + used.ru_stime, used.ru_maxrss / 1024, text


def main():
    parser = argparse.ArgumentParser()
    parser.add_argument("stride"), parser.add_argument("--count", type=int, default=200)
    parser.add_argument("--seed", type=int, default=1), parser.add_argument("--keep")
    parser.add_argument("--first", type=int, default=0)
    options = parser.parse_args()
    os.environ.setdefault("ASAN_OPTIONS", "detect_leaks=0:abort_on_error=0:exitcode=99")
    rng, bad, ends = random.Random(options.seed), 0, collections.Counter()
    slowest, most, total = 0.0, 0.0, 0.0
    with tempfile.TemporaryDirectory() as name:
        folder = pathlib.Path(name)
        files = originals(folder)
        for i in range(options.count):
            source = rng.choice(files)
            kind, data = damaged(source.read_bytes(), rng)
            clicked = rng.choice([30, 50, 70, 96])  # frames with clicks: a click beyond the end is refused
            if i < options.first:
                continue
            video = folder / f"damaged{source.suffix}"
            video.write_bytes(data)
            sums = subprocess.run(["sha256sum", video], capture_output=True, text=True).stdout.split()[0]
            clicks = json.loads((SOURCE / "small.keypoints.json").read_text())
            clicks["video_sha256"] = sums
            clicks["frames"] = [frame for frame in clicks["frames"] if frame["frame"] < clicked]
            (folder / "damaged.keypoints.json").write_text(json.dumps(clicks))
            for command in (["track", video, "-o", folder / "out" / "t.csv"],
                            ["convert", video, "-o", folder / "out", "--no-pictures", "--again"]):
                status, seconds, memory, said = run([options.stride, *map(str, command)])
                slowest, most, total = max(slowest, seconds), max(most, memory), total + seconds
                ends["ok" if status == 0 else "refused" if status in (1, 2) else "crash"] += 1
                if status not in (0, 1, 2):
                    bad += 1
                    print(f"{i}: {source.name}, {kind}: {command[0]}: status {status}\n{said[-2000:]}")
                    if options.keep:
                        pathlib.Path(options.keep).mkdir(parents=True, exist_ok=True)
                        shutil.copy(video, pathlib.Path(options.keep) / f"{i}-{kind}{source.suffix}")
            shutil.rmtree(folder / "out", ignore_errors=True)
            print(f"{i + 1}: {dict(ends)}; {total:.0f} s of processor time, slowest {slowest:.1f} s, "
                  f"most memory {most:.0f} MB", file=sys.stderr, flush=True)
    print(f"{options.count - options.first} videos, {dict(ends)}; {total:.0f} s of processor time, "
          f"slowest {slowest:.1f} s, most memory {most:.0f} MB")
    sys.exit(1 if bad else 0)


if __name__ == "__main__":
    main()
