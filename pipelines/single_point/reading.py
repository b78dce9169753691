"""Reading of a single-point study; its `[[maps]]` are checked."""

from pathlib import Path

from ..common.weather.streams import with_files
from ..site.link import read_study_at_site
from .maps import check_maps
from .tables import make_study


def read_study(path):
    """The Study of a TOML file, its nested dictionaries, and the text of the file.  Raises StudyError."""
    raw, text = with_files(*read_study_at_site(Path(path), "a study"), path)
    study = make_study(raw)
    check_maps(raw, study)
    return study, raw, text
