"""The one kind of failure that is the user's to mend."""


class InputError(Exception):
    """A file, key or value that is not as it should be: one line that says what was found and how to mend it (exit 2)."""
