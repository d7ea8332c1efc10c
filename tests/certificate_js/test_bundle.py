from __future__ import annotations

import json
import subprocess

from certified_arms import issac
from second_checker import FOLDER, NODE, needs_node
from structured_arms import some_structures

from cuspaudit.certificate import text_from_certificate
from cuspaudit.certificate_js import checker_script
from cuspaudit.certificate_js.bundle import MODULES


def test_every_module_is_in_the_script() -> None:
    """The page runs all that Node runs, in an order in which each finds its own."""
    assert sorted(MODULES) == sorted(file.stem for file in FOLDER.glob("*.js"))
    script = checker_script()
    assert "import " not in script.replace("import it", "")
    assert "\nexport " not in script
    assert "</" not in script


@needs_node
def test_the_script_gives_the_answer_of_the_modules() -> None:
    """True claims accepted, a false one refused, by the script alone."""
    assert NODE is not None
    claims = [issac(), some_structures()["universal"]]
    texts = [text_from_certificate(claim) for claim in claims]
    texts.append(texts[0].replace('"sign": 1', '"sign": -1'))
    call = f"{checker_script()}; for (const text of {json.dumps(texts)})"
    call += "console.log(cuspauditCertificate.checkCertificate(text).accepted);"
    run = subprocess.run(
        [NODE, "-"], input=call, capture_output=True, text=True, timeout=60, check=True
    )
    assert run.stdout.split() == ["true", "true", "false"]
