"""The manual, built by `make docs` with Sphinx; every warning is an error there."""

import sys
from pathlib import Path

DOCS = Path(__file__).parent
sys.path.insert(0, str(DOCS))

import reference_pages  # noqa: E402 - found beside this file
from yawdamp_ros.version import VERSION  # noqa: E402 - as above

project = "yawdamp_ros"
author = "yawdamp_ros maintainers"
version = release = VERSION
html_title = f"yawdamp_ros {VERSION}"

extensions = [
    "myst_parser",
    "sphinx.ext.autodoc",
    "sphinx.ext.autosummary",
    "sphinx.ext.mathjax",
    "numpydoc",
    "sphinx_gallery.gen_gallery",
]
exclude_patterns = ["_build", "reproduction", "gallery"]
source_suffix = {".md": "markdown", ".rst": "restructuredtext"}
nitpicky = False  # a type such as "ndarray, shape (n,)" is prose, not a link

myst_enable_extensions = ["colon_fence", "dollarmath", "deflist"]
myst_heading_anchors = 3

templates_path = ["_templates"]  # classes without what they inherit: StrEnum has all of str
autosummary_generate = True
autodoc_member_order = "bysource"
autodoc_typehints = "none"  # the docstrings give types with shapes and units
numpydoc_show_class_members = False
numpydoc_class_members_toctree = False

sphinx_gallery_conf = {
    "examples_dirs": str(DOCS / "gallery"),
    "gallery_dirs": "auto_gallery",
    "filename_pattern": r"\.py$",
    "abort_on_example_error": True,
    "download_all_examples": False,
    "show_memory": False,
    "image_scrapers": ("matplotlib",),
    "matplotlib_animations": False,
    "remove_config_comments": True,
    "min_reported_time": 60,
}
suppress_warnings = ["config.cache"]  # the gallery's settings are no literals

html_theme = "pydata_sphinx_theme"
html_theme_options = {
    "navbar_align": "left",
    "show_toc_level": 2,
    "show_prev_next": True,
    "footer_start": ["copyright"],
    "footer_end": [],
    "secondary_sidebar_items": ["page-toc"],
}
html_static_path = ["_static"]
html_css_files = ["manual.css"]
html_show_sourcelink = False
copyright = "yawdamp_ros maintainers, Apache-2.0"  # noqa: A001 - Sphinx's name

reference_pages.write(DOCS / "reference")
