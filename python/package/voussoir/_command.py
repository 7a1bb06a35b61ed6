"""The command `voussoir`, as it is installed with the package."""

import os
import signal
import sys

from ._core import command


def main() -> int:
    """Run the command with the arguments of this process and return its exit code."""
    # The work is not the interpreter's: Ctrl-C ends it as it ends any other program.
    signal.signal(signal.SIGINT, signal.SIG_DFL)
    return command(os.path.abspath(sys.argv[0]), sys.argv[1:])


if __name__ == "__main__":
    sys.exit(main())
