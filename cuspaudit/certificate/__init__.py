"""The certificate of a witness and its checker, in ball arithmetic."""
