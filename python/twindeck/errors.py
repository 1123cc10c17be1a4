"""The two kinds of failure: what a user gave is wrong, and a step that did not finish."""


class InputError(ValueError):
    """A folder, file, column or value that is not as it should be: one line that says what was found and how to mend it."""


class StepError(RuntimeError):
    """A step that ended with another exit code than 0. The text is the step's own last line.

    Attributes
    ----------
    code : int
        1: a computation did not converge; 2: bad input; 3: a mistake of the program.
    command : list of str
        What was run.
    log : str
        Everything that the step printed on stderr.
    """

    def __init__(self, message: str, code: int, command: list, log: str):
        super().__init__(message)
        self.code, self.command, self.log = code, command, log
