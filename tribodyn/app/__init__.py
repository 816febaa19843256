"""The page to design on: a scenario as a form, with teeth, curves and numbers that follow every value.

`core` knows the scenario and computes; what lies beside it serves the page (`server`) and draws it. Nothing
else imports this folder but the verb `app` and `explore`, which need the extra ``tribodyn[app]``.
"""
