"""Renders a LuxCore configuration: what `pyluxcore-console` does, which in version 2.11.2 stops before it renders."""

import sys
import time

import pyluxcore

pyluxcore.Init()
if sys.argv[1] == "--version":
    print("LuxCore", pyluxcore.Version())
    sys.exit()
try:
    config = pyluxcore.RenderConfig(pyluxcore.Properties(sys.argv[1]))
    session = pyluxcore.RenderSession(config)
    session.Start()
    while not session.HasDone():
        time.sleep(0.02)
        session.UpdateStats()
    session.Stop()
    session.GetFilm().SaveOutputs()
except Exception as error:
    sys.exit(f"{type(error).__name__}: {error}")
