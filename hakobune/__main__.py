"""`python -m hakobune`: the `hakobune` command."""

import sys

from hakobune.pipelines.start import main

if __name__ == "__main__":
    sys.argv[0] = "hakobune"
    sys.exit(main())
