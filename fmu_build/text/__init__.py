"""The one reader of Modelica text: tokens, declarations, statements, libraries and names in them; and its writer."""

from fmu_build.text.classes import ClassText
from fmu_build.text.declarations import Declaration
from fmu_build.text.lookup import Libraries
from fmu_build.text.modify import with_values
from fmu_build.text.tokens import TextError, tokenise
from fmu_build.text.write import class_text

__all__ = ["ClassText", "Declaration", "Libraries", "TextError", "class_text", "tokenise", "with_values"]
