"""What lies in the folder where ``.tir`` files arrive, and what of it is new."""
