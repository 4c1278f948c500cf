"""What people read: each method is shown in one file.

`present/<method>.py` shows what one command finds. It has, in this order,

- the result as it is shown, where the analysis' own type lacks what the page says (a frozen dataclass);
- `text(result)`, for a terminal;
- `data(result)`, for JSON, whose keys are a contract with other programs;
- `figures(result)`, which yields `Picture(name, caption, figure)`;
- `page(result, drawings, redo)`, made with `pysim.present.page`;
- where a result comes with more files, `files(result)`: name -> content.

`style` and `page` give all of them one look, and cost no Matplotlib until a figure is made: figures are built from
`style.new_figure`, and types of Matplotlib are imported for the type checker alone. `text`, `data` and `write_report`
show any result: `report.VIEWS` says which file shows which type. `notes` has the words of every note. Where the
workbench or a notebook shows the same thing, its chart, which moves and zooms, stands beside the figure: `charts` has
what all of these share.
"""

from pysim.present.render import Drawing, Picture, render
from pysim.present.report import data, text, write_report

__all__ = ["Drawing", "Picture", "data", "render", "text", "write_report"]
