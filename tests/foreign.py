"""FMUs as other tools make them: ours, with what only ours have taken out."""

import re
import zipfile
from pathlib import Path

_TAKEN_OUT = (
    r' providesDirectionalDerivatives?="true"',
    r' providesAdjointDerivatives="true"',
    r' canGetAndSetF[Mm][Uu][Ss]tate="true"',
    r' canSerializeF[Mm][Uu][Ss]tate="true"',
    r' (min|max|nominal)="[^"]*"',
    r' dependencies="[^"]*"',
    r' dependenciesKind="[^"]*"',
)


def made_foreign(fmu: Path, output: Path, name: str = "Mass_from_elsewhere") -> Path:
    """A copy without source, directional derivatives, saved states, bounds and dependencies, by another name."""
    with zipfile.ZipFile(fmu) as old, zipfile.ZipFile(output, "w", zipfile.ZIP_DEFLATED) as new:
        for item in old.infolist():
            if item.filename.startswith(("sources/", "documentation/")):
                continue
            content = old.read(item)
            if item.filename == "modelDescription.xml":
                text = content.decode("utf-8")
                for pattern in _TAKEN_OUT:
                    text = re.sub(pattern, "", text)
                text = re.sub(r'modelName="[^"]*"', f'modelName="{name}"', text, count=1)
                text = re.sub(r'generationTool="[^"]*"', 'generationTool="Another tool"', text)
                content = text.encode("utf-8")
            new.writestr(item, content)
    return output
