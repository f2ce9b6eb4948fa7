"""``python -m lambda_cli``: the same program where the script is not on the path."""

import sys

from lambda_cli.start import main

sys.exit(main())
