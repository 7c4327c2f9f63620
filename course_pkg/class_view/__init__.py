"""The class view: a service that receives the results of checks, and shows them to the teacher on one page.

`course_pkg/sharing` sends the results. A student can forge their own results, so no grade depends on them.

- results: one result, and the validation of received results
- storage: the SQLite database
- model: what the page shows, computed from the results
- identity: the owner of a token, without a hub or with a JupyterHub
- tokens: the file with one token for each student
- service, pages: the HTTP interface
"""
