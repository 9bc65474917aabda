"""What the program's errors are in Python."""


class Error(ValueError):
    """Bad input or a missing part. The message names what was wrong, its value and the allowed range.

    kind: "usage", "bad_input", "no_device", "out_of_memory" or "internal"; hint: one thing to try, or "".
    """

    def __init__(self, message: str, kind: str = "usage", hint: str = ""):
        super().__init__(message)
        self.kind = kind
        self.hint = hint

    def __reduce__(self):
        return Error, (str(self), self.kind, self.hint)
