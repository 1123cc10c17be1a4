"""Holds a commit message against the habits of CONTRIBUTING.md: a subject of at most 72 characters without a full stop, an empty line, a body.

commit_message.py FILE                 the message in FILE (git's commit-msg hook)
commit_message.py --since REVISION     the messages of REVISION..HEAD
"""
import pathlib
import subprocess
import sys

LONGEST_SUBJECT = 72  # characters, as git's own tools cut it


def complaints(message: str) -> list[str]:
    lines = [line for line in message.rstrip().splitlines() if not line.startswith("#")] or [""]
    found = []
    if len(lines[0]) > LONGEST_SUBJECT:
        found.append(f"the subject has {len(lines[0])} characters, at most {LONGEST_SUBJECT} are allowed")
    if lines[0].endswith("."):
        found.append("the subject ends in a full stop")
    if len(lines) < 3 or lines[1].strip():
        found.append("there is no body: leave a line empty, then say why")
    return found


def main(arguments: list[str]) -> int:
    if arguments[:1] == ["--since"]:
        log = subprocess.run(["git", "log", "--no-merges", "--format=%h%x00%B%x01", f"{arguments[1]}..HEAD"], check=True, capture_output=True, text=True)
        messages = [entry.strip().split("\0", 1) for entry in log.stdout.split("\x01") if entry.strip()]
    else:
        messages = [[arguments[0], pathlib.Path(arguments[0]).read_text()]]
    failed = False
    for name, message in messages:
        for complaint in complaints(message):
            print(f"{name}: {message.splitlines()[0] if message else ''}: {complaint}", file=sys.stderr)
            failed = True
    return 1 if failed else 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
