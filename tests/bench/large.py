"""What a large panel problem takes, beside what the command says before it starts.

    python tests/bench/large.py [panels]

Box 100 × 50 × 10 m in 20 m of water, two mirror planes, six motions and one heading at two frequencies, with the
estimated errors that the command makes, too.  20 000 panels took six to eleven minutes, from machine to machine,
and 14 GB.
"""

import sys
import tempfile
import time
from pathlib import Path

sys.path.insert(0, str(Path(__file__).parents[2]))

from rich.console import Console

from pipelines.bench.peers.repeated import peak_memory
from pipelines.common.progress import duration
from pipelines.scene.scene import make_scene
from pipelines.solve.run import solve


def main(panels):
    scene = make_scene(
        {
            "water": {"depth": 20.0},
            "bodies": [{"shape": "box", "length": 100.0, "beam": 50.0, "draft": 10.0}],
            "waves": {"omegas": [0.3, 0.6], "headings_deg": [45.0]},
            "method": "panel",
            "panels": panels,
            "want": ["radiation", "excitation_force"],
        }
    )
    with tempfile.TemporaryDirectory() as folder:
        start = time.perf_counter()
        outcome = solve(scene, Path(folder) / "box.h5", console=Console())
        print(f"took {duration(time.perf_counter() - start)} in all, {1.048576e-3 * peak_memory():.1f} GB at most")
    return outcome.exit_status


if __name__ == "__main__":
    sys.exit(main(int(sys.argv[1]) if len(sys.argv) > 1 else 20_000))
