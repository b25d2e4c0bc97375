#!/usr/bin/python3
"""A rig beyond the command line's own trust: certificates made, carried and refused, by the programs alone."""

import json
import os

from harness import ENVIRONMENT, INVALID, USAGE, expect, focalstage, folder, main, rig, succeed


def configure(at, **more):
    """A rig.json whose certificates are in `at`/pki; returns its path."""
    config = {"focalstage_rig": 1, "network": {"certificate": "pki/rig.pem", "key": "pki/rig.key", "client_ca": "pki/ca.pem"},
              **more}
    (at / "rig.json").write_text(json.dumps(config))
    return at / "rig.json"


def mode(path):
    return os.stat(path).st_mode & 0o777


def test_pairing_from_end_to_end():
    """A computer that was paired does what its rights allow; one that was not is told what it lacks."""
    with folder() as at:
        pki, home = at / "pki", {"FOCALSTAGE_CREDENTIALS": str(at / "kept")}
        succeed("pair", "init", pki, "--host", "127.0.0.1", "--host", "localhost")
        assert mode(pki / "ca.key") == mode(pki / "rig.key") == 0o600
        said = succeed("pair", "client", pki, "lobby", "-o", at / "lobby.pair").out
        assert mode(at / "lobby.pair") == 0o600
        client = json.loads(said.split("rig.json: ")[1])
        assert client["name"] == "lobby" and client["rights"] == ["watch"], client
        assert client["fingerprint"] in succeed("pair", "show", at / "lobby.pair").out
        with rig(at, "--config", str(configure(at, clients=[client]))) as address:
            expect(focalstage("rig", "state", "--to", address, environment=home), ENVIRONMENT, "rig.unpaired", "pair import")
            succeed("pair", "import", at / "lobby.pair", "--to", address, environment=home)
            assert succeed("rig", "state", "--to", address, "--json", environment=home).json()["state"] == "empty"
            succeed("rig", "blackout", "--to", address, environment=home)
            expect(focalstage("rig", "go", "--to", address, environment=home), ENVIRONMENT, "rig.unauthorised", "lobby")
        # The rig's certificate anew, for another name: the same computer says what is wrong.
        succeed("pair", "rig", pki, "--host", "rig.example")
        with rig(at, "--config", str(at / "rig.json")) as address:
            succeed("pair", "import", at / "lobby.pair", "--to", address, environment=home)
            expect(focalstage("rig", "state", "--to", address, environment=home), ENVIRONMENT, "rig.certificate", "rig.example")


def test_what_pair_refuses():
    with folder() as at:
        pki = at / "pki"
        expect(focalstage("pair", "init", pki), USAGE, "--host")
        succeed("pair", "init", pki, "--host", "localhost")
        before = (pki / "ca.pem").read_bytes()
        expect(focalstage("pair", "init", pki, "--host", "localhost"), INVALID, "ca.key", "credentials.exists")
        assert (pki / "ca.pem").read_bytes() == before
        expect(focalstage("pair", "client", pki), USAGE, "NAME")
        expect(focalstage("pair", "client", at / "none", "x"), INVALID, "none")
        expect(focalstage("pair", "import", pki / "rig.pem", "--to", "localhost:1"), INVALID, "rig.pem")
        expect(focalstage("pair", "import", pki / "rig.pem"), USAGE, "--to")


if __name__ == "__main__":
    main([test_pairing_from_end_to_end, test_what_pair_refuses])
