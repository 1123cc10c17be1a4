"""A guide's blocks: files to write, commands to run, and what these are said to print."""

import re

FENCE = re.compile(r"^```(\w*) *(\S*)\n(.*?)^```$", re.M | re.S)
NUMBER = re.compile(r"[-+]?(?:\d+\.?\d*|\.\d+)(?:[eE][-+]?\d+)?")


def blocks(text):
    """[(language, name, content)] in order."""
    return [match.groups() for match in FENCE.finditer(text)]


def units_of_last_digit(printed):
    """Size of one unit of the last digit that is printed: 2.467 -> 0.001, 1.2e-3 -> 1e-4."""
    mantissa, _, exponent = printed.lower().partition("e")
    decimals = len(mantissa.partition(".")[2])
    return 10.0 ** (int(exponent or 0) - decimals)


def differences(said, printed):
    """What differs between the guide's text and the program's, where numbers count to the digits that the guide states."""
    found = []
    said_lines, printed_lines = said.strip().splitlines(), printed.strip().splitlines()
    if len(said_lines) != len(printed_lines):
        return [f"{len(said_lines)} lines in the guide, {len(printed_lines)} printed:\n{printed}"]
    for a, b in zip(said_lines, printed_lines):
        if NUMBER.sub("#", a) != NUMBER.sub("#", b):
            found.append(f"guide: {a}\n   ran: {b}")
            continue
        for x, y in zip(NUMBER.findall(a), NUMBER.findall(b)):
            if abs(float(x) - float(y)) > 0.5000001 * units_of_last_digit(x) + 1e-12:
                found.append(f"guide: {x} in '{a}'\n   ran: {y}")
    return found


def refreshed(text, run):
    """The guide with each ```text block as `run(command)` prints it now, to as many digits as stood there."""
    printed = ""

    def block(match):
        nonlocal printed
        language, _, content = match.groups()
        if language == "sh":
            printed = run(content)
        if language != "text" or not differences(content, printed):
            return match.group(0)
        return f"```text\n{_to_digits(content, printed)}```"

    return FENCE.sub(block, text)


def _to_digits(said, printed):
    """`printed` with the significant digits of the longest number of `said`."""
    digits = max([len(re.sub(r"[eE].*|[-+.]", "", n).lstrip("0")) for n in NUMBER.findall(said) if "." in n] or [6])
    return NUMBER.sub(lambda m: f"{float(m.group()):.{digits}g}" if "." in m.group() else m.group(), printed)
