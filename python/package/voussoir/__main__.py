"""`python -m voussoir` is the command `voussoir`."""

import sys

from ._command import main

sys.exit(main())
