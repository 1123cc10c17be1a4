"""Inputs whose content is not what a step read although their time is not newer than its manifest: `cp -p`, or equal times.

Make compares times alone. The time of a file's last change of any kind (ctime) is set by the system whenever its content, its times or its name
change, so only files with a ctime from the manifest's time on are read, and their SHA-256 is held against the manifest's.

Prints words for steps.mk: `manifest:FILE{blank}has{blank}changed`, a rule by which the step runs again, and the same name with a colon behind it, a
rule of a file that is never there. Usage: changed_inputs.py results/my_bridge MANIFEST ...
"""
import hashlib
import json
import os
import re
import sys

SIGNS_OF_MAKE = re.compile(r"[$*?;|&~=%:#{}\\\[\]]")  # recorded_inputs.sh leaves out the same names


def sha256(path):
    digest = hashlib.sha256()
    with open(path, "rb") as file:
        while block := file.read(1 << 20):
            digest.update(block)
    return digest.hexdigest()


def is_changed(path, recorded, written_ns):
    """Edited after `written_ns`, the manifest's time, under a time of before it."""
    try:
        stat = os.stat(path)
        return stat.st_ctime_ns >= written_ns >= stat.st_mtime_ns and sha256(path) != recorded
    except OSError:
        return False  # a file that is gone makes the step run again by another rule


def main(results, manifests):
    changed = set()
    for manifest in manifests:
        try:
            with open(manifest, encoding="utf-8") as file:
                inputs = json.load(file).get("inputs", {})
        except (OSError, ValueError):
            continue  # the step that reads it says what is wrong with it
        written_ns = os.stat(manifest).st_mtime_ns
        for path, recorded in inputs.items():
            if SIGNS_OF_MAKE.search(path) or path.startswith(results + "/") or not is_changed(path, recorded, written_ns):
                continue
            word = f"{path} has changed".replace(" ", "{blank}")
            print(f"{manifest}:{word}")
            changed.add(word)
    for word in changed:
        print(f"{word}:")


if __name__ == "__main__":
    main(sys.argv[1].rstrip("/"), sys.argv[2:])
