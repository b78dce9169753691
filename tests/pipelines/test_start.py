"""Where the process begins."""

import subprocess
import sys


def test_scipy_loads_no_package_of_numpy_that_nothing_uses_and_each_is_there_when_it_is_used():
    lines = (
        "import sys; from pipelines.start import _spare_numpy; _spare_numpy()",
        "import scipy.special, scipy.linalg, numpy",
        "assert not {'numpy.f2py', 'numpy.testing'} & set(sys.modules)",
        "numpy.testing.assert_equal(1, 1)",
        "assert 'numpy.testing' in sys.modules",
        "import numpy.testing, numpy.f2py; assert numpy.f2py.__file__ and numpy.testing.__file__",
    )
    subprocess.run([sys.executable, "-c", "\n".join(lines)], check=True)
