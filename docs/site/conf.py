"""Settings of Sphinx for the site. `docs/build_site` calls Sphinx."""
import os
import pathlib

project = "Hyperlattice"
version = release = os.environ.get("HYPERLATTICE_VERSION", "")
html_title = f"Hyperlattice {version}"
extensions = ["myst_parser", "nbsphinx"]
root_doc = "index"
myst_heading_anchors = 4
myst_enable_extensions = ["colon_fence"]
nbsphinx_execute = "never"  # the notebooks run as tests
# These would come from the network. Formulas are written as code, as on all pages: a page with a formula would fail,
# because this file does not exist.
nbsphinx_requirejs_path = ""
nbsphinx_assume_equations = False
mathjax_path = "pages_have_no_formulas.js"
html_theme = "furo"
html_static_path = [str(pathlib.Path(__file__).parent / "site.css")]
html_css_files = ["site.css"]
html_copy_source = False
html_show_copyright = False
html_show_sphinx = False
highlight_language = "none"
suppress_warnings = ["misc.highlighting_failure"]  # JSON with comments, and parts of scenes
