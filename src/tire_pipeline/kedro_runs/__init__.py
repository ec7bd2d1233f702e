"""What happens around a run of Kedro: hooks, and errors in one line."""
