"""Which effects the recording holds: screened, refitted jointly, tested."""
