"""A program that stands for omc: its start, its port file, its answers and its messages, over the real protocol.

OMPython talks to it as it would to omc. How it behaves is told by a JSON file that $FAKE_OMC names:

    fmu       file that buildModelFMU leaves as its result, absent: none
    refuses   expression (its beginning): [answer, [message, ...]]; a message is [level, text, file, line]
    dies      expression (its beginning) at which it ends without an answer
    starts    false: ends at once with words of its own, as omc does for the user root
    log       file to which every expression goes
"""

import json
import os
import re
import shutil
import sys
import tempfile
from pathlib import Path

RECORD = """record OpenModelica.Scripting.ErrorMessage
    info = record OpenModelica.Scripting.SourceInfo
        filename = "{file}",
        readonly = false,
        lineStart = {line},
        columnStart = 3,
        lineEnd = {line},
        columnEnd = 20
    end OpenModelica.Scripting.SourceInfo;,
    message = "{text}",
    kind = .OpenModelica.Scripting.ErrorKind.translation,
    level = .OpenModelica.Scripting.ErrorLevel.{level},
    id = 1
end OpenModelica.Scripting.ErrorMessage;"""


class Omc:
    """What it has been told so far decides what it answers."""

    def __init__(self, told: dict) -> None:
        self.told, self.messages = told, []

    def answer(self, expression: str) -> str:
        if expression == "getMessagesStringInternal()":
            records = ",".join(RECORD.format(level=a, text=b, file=c, line=d) for a, b, c, d in self.messages)
            self.messages = []
            return "{" + records + "}\n"
        with Path(self.told["log"]).open("a") as log:
            log.write(expression + "\n")
        if expression.startswith(self.told.get("dies", "no such expression")):
            os._exit(139)
        for beginning, (answer, messages) in self.told.get("refuses", {}).items():
            if expression.startswith(beginning):
                self.messages = messages
                return answer + "\n"
        return self.usual(expression) + "\n"

    def usual(self, expression: str) -> str:
        if expression.startswith("cd("):
            os.chdir(re.findall(r'"(.*)"', expression)[0])
            return f'"{Path.cwd().as_posix()}"'
        if expression.startswith("buildModelFMU("):
            target = Path(re.findall(r'fileNamePrefix="(.*?)"', expression)[0] + ".fmu")
            shutil.copyfile(self.told["fmu"], target)
            return f'"{target.resolve().as_posix()}"'
        return '""' if expression == "getErrorString()" else "true"


def main() -> int:
    if "--version" in sys.argv:
        print("OpenModelica 1.28.0")
        return 0
    told = json.loads(Path(os.environ["FAKE_OMC"]).read_text())
    if told.get("starts") is False:
        print("Error: You are trying to run OpenModelica as a server using the root user.", flush=True)
        return 1
    import zmq

    socket = zmq.Context().socket(zmq.REP)
    port = socket.bind_to_random_port("tcp://127.0.0.1")
    suffix = next(word for word in sys.argv if word.startswith("-z=")).removeprefix("-z=")
    file = Path(tempfile.gettempdir()) / f"openmodelica.port.{suffix}"
    file.write_text(f"tcp://127.0.0.1:{port}")
    print(f"Created ZeroMQ Server.\nDumped server port in file: {file}", flush=True)
    omc = Omc(told)
    try:
        while (expression := socket.recv_string()) != "quit()":
            socket.send_string(omc.answer(expression))
    finally:
        file.unlink(missing_ok=True)
    return 0


if __name__ == "__main__":
    sys.exit(main())
