"""Who may ask the server, and what its pages may do."""

from starlette.datastructures import Headers
from starlette.responses import PlainTextResponse

POLICY = ("default-src 'self' data: blob: 'unsafe-inline' 'unsafe-eval'; connect-src 'self'; form-action 'none'; base-uri 'none'; "
          "object-src 'none'; frame-ancestors 'none'")  # the library's own scripts, and nothing from anywhere else
HEADERS = {"Content-Security-Policy": POLICY, "Referrer-Policy": "no-referrer", "X-Content-Type-Options": "nosniff",
           "Cross-Origin-Resource-Policy": "same-origin", "Cross-Origin-Opener-Policy": "same-origin"}


class Guard:
    """Lets through what was asked of this address, by this page or by nobody else's; websockets, too."""

    def __init__(self, app, hosts):
        self.app, self.hosts = app, hosts

    async def __call__(self, scope, receive, send):
        if scope["type"] not in ("http", "websocket"):
            return await self.app(scope, receive, send)
        headers = Headers(scope=scope)
        host, origin = headers.get("host", ""), headers.get("origin")
        if host not in self.hosts or origin not in (None, f"http://{host}"):
            if scope["type"] == "websocket":
                return await send({"type": "websocket.close", "code": 1008})
            return await PlainTextResponse("refused: asked by another page or for another machine\n", 403)(scope, receive, send)

        async def send_with_headers(message):
            if message["type"] == "http.response.start":
                message["headers"] = [*message["headers"], *((name.lower().encode(), words.encode()) for name, words in HEADERS.items())]
            await send(message)

        return await self.app(scope, receive, send_with_headers)
