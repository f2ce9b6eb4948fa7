"""Run the program by ``python -m lambda_cli``."""

import sys

from lambda_cli.start import main

sys.exit(main())
