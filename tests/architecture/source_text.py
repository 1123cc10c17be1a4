"""The text of a C++ file as those read it who look at its code alone."""
import re

BLANKED = re.compile(
    r"//[^\n]*"  # comments
    r"|/\*.*?\*/"
    r'|R"(?P<mark>[^()\s\\]*)\(.*?\)(?P=mark)"'  # strings; an apostrophe after a digit separates thousands
    r'|"(?:\\.|[^"\\\n])*"'
    r"|(?<![0-9A-Za-z_])'(?:\\.|[^'\\\n])+'"
    r"|^[ \t]*#(?:[^\n\\]|\\.|\\\n)*", re.S | re.M)  # preprocessor lines


def blanked(text):
    """The text with comments, strings, characters and preprocessor lines replaced by spaces; lines stay where they are."""
    return BLANKED.sub(lambda found: re.sub(r"[^\n]", " ", found.group()), text)
