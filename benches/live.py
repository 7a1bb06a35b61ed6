"""How long the page that lives waits for its answers: from the request of a slider to the first answer, and to the last.

    python benches/live.py target/release/voussoir SCENE POINTER FROM TO [question] [steps]

Starts `voussoir open SCENE`, moves the number at the JSON pointer from FROM to TO in steps, waits for all answers to each, and prints the
median, the slowest, and the bytes of an answer. A scene of another program is made one first: `voussoir import FILE --json`.
"""

import http.client
import json
import statistics
import subprocess
import sys
import threading
from time import perf_counter
from urllib.parse import urlparse


def events(host, port, path, heard, told):
    """Every event with the time at which its last byte was there."""
    connection = http.client.HTTPConnection(host, port)
    connection.request("GET", path + "events")
    stream = connection.getresponse()
    kind = None
    for line in iter(stream.readline, b""):
        if line.startswith(b"event: "):
            kind = line[7:].strip().decode()
        elif line.startswith(b"data: "):
            with told:
                heard.append((perf_counter(), kind, line[6:]))
                told.notify_all()


def main(program, scene, pointer, first, last, question="assess", steps="15"):
    server = subprocess.Popen([program, "open", scene], stdout=subprocess.PIPE, stderr=subprocess.DEVNULL, text=True)
    try:
        for line in server.stdout:
            if "http://" in line:
                break
        url = urlparse("http://" + line.split("http://")[1].split()[0])
        heard, told = [], threading.Condition()
        threading.Thread(target=events, args=(url.hostname, url.port, url.path, heard, told), daemon=True).start()

        def until(kind, after, test=lambda data: True):
            with told:
                while True:
                    for time, what, data in heard[after:]:
                        if what == kind and test(json.loads(data)):
                            return time, len(data), json.loads(data)
                    told.wait(120)

        epoch = until("scene", 0)[2]["epoch"]
        until("status", 0, lambda d: "seconds" in d)
        coarse, fine, size, built = [], [], [], []
        for k in range(int(steps)):
            value = float(first) + (float(last) - float(first)) * k / (int(steps) - 1)
            body = json.dumps({"question": {question: {}}, "epoch": epoch, "edits": {pointer: value}})
            after, start = len(heard), perf_counter()
            connection = http.client.HTTPConnection(url.hostname, url.port)
            connection.request("POST", url.path + "ask", body, {"Content-Type": "application/json"})
            revision = json.loads(connection.getresponse().read())["revision"]
            own = lambda d: d["revision"] == revision
            time, length, data = until("answer", after, own)
            coarse.append(time - start)
            built.append(data["seconds"])
            size.append(length)
            fine.append(until("status", after, lambda d: own(d) and ("seconds" in d or "error" in d))[0] - start)
        ms = lambda list: f"{1e3 * statistics.median(list):.0f} ms (slowest {1e3 * max(list):.0f})"
        print(f"{scene}: {question}, {steps} values")
        print(f"  first answer {ms(coarse)}, of which asked {ms(built)}; all answers {ms(fine)}; {statistics.median(size) / 1e6:.2f} MB")
    finally:
        server.terminate()


main(*sys.argv[1:])
