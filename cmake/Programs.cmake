# Executables: a main.cpp in programs' own folders, linked to the rooms they start.
