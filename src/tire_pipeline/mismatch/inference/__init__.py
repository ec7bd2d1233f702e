"""Which effects a recording contains: they are screened, fitted together and tested."""
