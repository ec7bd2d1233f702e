"""The keys of the tests' bucket."""

KEY, SECRET = "AKIATESTKEY", "sEcReT-not-to-be-seen"
