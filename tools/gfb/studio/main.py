"""A page in the browser for gfb: a case as a form and as text, checked while it is typed, its runs, results side by side.

  tools/studio [FOLDER]     then open the address that it prints; Ctrl-C ends it, and the runs that it began

It reads and writes case files in FOLDER and gives each run a folder of its own in it; nothing outside is touched. Only this
machine reaches the page (127.0.0.1), and only who knows the address, of which a part is random. Exit status: 0 ended,
1 there is no such folder or program, 3 the port is taken.
"""

import asyncio
import contextlib
import logging
import os
import pathlib
import secrets
import socket
import traceback

from gfb.program import find_program
from gfb.tool import draw_into_files, parser_of, stop

HOST = "127.0.0.1"
GOODBYE = 2  # s for what is still being sent
SHOWN = 200  # letters of what is said of something that went wrong
TALKING = ("engineio.server", "socketio.server")  # they would say everything in their own way, too


def main():
    parser = parser_of("tools/studio", __doc__)
    parser.add_argument("folder", nargs="?", type=pathlib.Path, default=pathlib.Path(), metavar="FOLDER",
                        help="of case files and runs; default: here")
    parser.add_argument("--port", type=int, default=0, help="default: one that is free")
    parser.add_argument("--gfb", help="the program; default: as gfb from Python finds it")
    parser.add_argument("--install", action="store_true", help="only put the library NiceGUI into build/studio_venv, as the first start does")
    options = parser.parse_args()
    if options.install:
        return 0  # done before this was called
    if not options.folder.is_dir():
        stop(f"{options.folder}: there is no such folder")
    try:
        gfb = find_program(options.gfb)
    except FileNotFoundError as error:
        stop(str(error))
    draw_into_files()
    with contextlib.closing(socket.socket()) as door:
        door.setsockopt(socket.SOL_SOCKET, socket.SO_REUSEADDR, 1)
        try:
            door.bind((HOST, options.port))
        except (OSError, OverflowError) as error:
            stop(f"--port {options.port}: {error}", 3)
        serve(door, options.folder, gfb)
    return 0


class OneLine(logging.Formatter):
    """What goes wrong in a line: what a browser, or somebody else, sends may be anything."""

    def format(self, record):
        words = [(record.getMessage().splitlines() or [""])[0].strip()]
        if record.exc_info and record.exc_info[1] is not None:
            error = record.exc_info[1]
            words.append(" ".join(f"{type(error).__name__}: {error}".split()))
            words += [f"{pathlib.Path(one.filename).name}, line {one.lineno}" for one in traceback.extract_tb(error.__traceback__)[-1:]]
        return "gfb studio: " + "; ".join(one[:SHOWN] for one in words)


def say_in_lines():
    """From now on what goes wrong is a line each."""
    handler = logging.StreamHandler()
    handler.setFormatter(OneLine())
    logging.basicConfig(handlers=[handler], level=logging.WARNING, force=True)
    for name in TALKING:
        logging.getLogger(name).setLevel(logging.ERROR)  # to one with a level they add nothing


def serve(door, folder, gfb):
    """Serves the page until a signal comes."""
    say_in_lines()
    os.environ.setdefault("NICEGUI_STORAGE_PATH", os.devnull)  # nothing is kept in files
    import uvicorn
    from fastapi import FastAPI
    from nicegui import ui

    from gfb.studio.gate import Guard
    from gfb.studio.page import make_page

    token, port = secrets.token_urlsafe(24), door.getsockname()[1]
    app = FastAPI(docs_url=None, redoc_url=None, openapi_url=None)
    make_page(folder, gfb)
    ui.run_with(app, mount_path=f"/{token}", title="gfb studio", tailwind=False, show_welcome_message=False, reconnect_timeout=30.0)
    server = uvicorn.Server(uvicorn.Config(Guard(app, {f"{HOST}:{port}", f"localhost:{port}"}), loop="asyncio", log_level="warning", log_config=None, timeout_graceful_shutdown=GOODBYE,
                                           lifespan="on", server_header=False, ws_max_size=2**24))
    print(f"gfb studio: http://{HOST}:{port}/{token}/", flush=True)
    print(f"cases and runs are in {folder.resolve()}; Ctrl-C ends it, and the runs that it began", flush=True)
    with contextlib.suppress(KeyboardInterrupt):
        asyncio.run(server.serve(sockets=[door]))
