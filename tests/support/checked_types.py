"""The type check, left out where it passed with the same sources, settings and packages.

python -m tests.support.checked_types
"""

import subprocess
import sys

from tests.support.passed_before import FOLDER, ROOT, digest_of
from tribodyn.numerics.files.cache import keep, read_kept

#: What is checked by `[tool.basedpyright]` of pyproject.toml, and what that imports.
CHECKED = ("tribodyn", "tools", "tests/support")

if __name__ == "__main__":
    now = digest_of(CHECKED, [ROOT / "pyproject.toml"]).encode()
    if read_kept(FOLDER, "types") == now:
        sys.exit(print("types: passed before with the same sources"))
    status = subprocess.run([sys.executable, "-m", "basedpyright"], cwd=ROOT, check=False).returncode
    if status == 0:
        keep(FOLDER, "types", now)
    sys.exit(status)
