"""One peer on one model, in a process of its own: python one.py PEER MODEL.json -> one line of JSON."""

import json
import sys
from time import perf_counter, process_time

from model import load
from peers import PEERS

if __name__ == "__main__":
    name, path = sys.argv[1:3]
    start = perf_counter()
    model = load(path)
    read = perf_counter() - start
    value, build, solve, word = PEERS[name][2](model)
    print(json.dumps({"value": value, "read": read, "build": build, "solve": solve, "word": word, "cpu": process_time()}))
