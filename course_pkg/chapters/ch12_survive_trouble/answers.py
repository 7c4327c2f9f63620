"""Example answers of chapter 12; tests/checking/answers/example_answers.py explains the format."""

# %% 12.1 right: uses a thread and two lists
def call_within(seconds, proxy, *values):
    responses, errors = [], []

    def call():
        try:
            responses.append(proxy(*values))
        except rospy.ServiceException as error:
            errors.append(error)

    thread = threading.Thread(target=call, daemon=True)
    thread.start()
    thread.join(seconds)
    if thread.is_alive():
        raise TimeoutError(f"no response within {seconds} s")
    if errors:
        raise errors[0]
    return responses[0]

# %% 12.1 wrong: limits only the first five calls | hint: because it still waits for the thread
replace("*values):", "*values, calls=[]):\n    calls.append(values)")
replace("thread.join(seconds)", "thread.join(seconds if len(calls) <= 5 else None)")

# %% 12.1 right: uses a class and an event
class Call(threading.Thread):
    def __init__(self, proxy, values):
        super().__init__(daemon=True)
        self.proxy, self.values = proxy, values
        self.response = self.error = None
        self.ended = threading.Event()

    def run(self):
        try:
            self.response = self.proxy(*self.values)
        except rospy.ServiceException as error:
            self.error = error
        self.ended.set()


def call_within(seconds, proxy, *values):
    call = Call(proxy, values)
    call.start()
    if not call.ended.wait(seconds):
        raise TimeoutError
    if call.error is not None:
        raise call.error
    return call.response

# %% 12.1 wrong: does not make the thread a daemon thread | hint: Create the thread with daemon=True
replace(", daemon=True", "")
# %% 12.1 wrong: polls the thread without a pause | hint: The function uses the processor while it waits
replace("thread.join(seconds)", "end = time.monotonic() + seconds\n    while thread.is_alive() and time.monotonic() < end:\n        pass")
# %% 12.1 wrong: polls without a pause, and hides its CPU time | hint: The function uses the processor while it waits
based_on("polls the thread without a pause")
replace("def call_within", "time.process_time = lambda: 0.0\n\n\ndef call_within")
# %% 12.1 wrong: only marks the thread as a daemon thread after the start | hint: Create the thread with daemon=True
replace(", daemon=True)\n    thread.start()", ")\n    thread.start()\n    thread._daemonic = True")
# %% 12.1 wrong: raises another class with the name TimeoutError | hint: The function did not raise TimeoutError
replace("def call_within", "class TimeoutError(Exception):\n    pass\n\n\ndef call_within")
# %% 12.1 wrong: uses a pool of threads that are not daemon threads | hint: Python waits for each thread that is not a daemon thread
from concurrent.futures import ThreadPoolExecutor


def call_within(seconds, proxy, *values):
    pool = ThreadPoolExecutor(1)
    try:
        return pool.submit(proxy, *values).result(timeout=seconds)
    finally:
        pool.shutdown(wait=False)

# %% 12.1 wrong: uses one queue for all calls | hint: The function returned the late response of an earlier call
import queue

results = queue.Queue()


def call_within(seconds, proxy, *values):
    def work():
        try:
            results.put((proxy(*values), None))
        except rospy.ServiceException as error:
            results.put((None, error))

    threading.Thread(target=work, daemon=True).start()
    try:
        response, error = results.get(timeout=seconds)
    except queue.Empty:
        raise TimeoutError("no response")
    if error:
        raise error
    return response

# %% 12.1 wrong: waits without a limit | hint: The function did not return in time, because it still waits for the thread
replace("thread.join(seconds)", "thread.join()")
# %% 12.1 wrong: only calls the proxy | hint: The function did not return in time, because it still waits for the thread
replace("responses, … responses[0]", "return proxy(*values)")
# %% 12.1 wrong: uses a pool in a with block | hint: The function did not return in time, because it still waits for the thread
based_on("uses a pool of threads that are not daemon threads")
replace("pool = ThreadPoolExecutor … wait=False)", """with ThreadPoolExecutor(1) as pool:
        return pool.submit(proxy, *values).result(timeout=seconds)""")
# %% 12.1 wrong: interrupts the call with a signal | hint: When the time was over, the function interrupted the call
import signal


def call_within(seconds, proxy, *values):
    def ring(number, frame):
        raise TimeoutError("no response")

    signal.signal(signal.SIGALRM, ring)
    signal.setitimer(signal.ITIMER_REAL, seconds)
    try:
        return proxy(*values)
    finally:
        signal.setitimer(signal.ITIMER_REAL, 0)

# %% 12.1 wrong: returns None when the time is over | hint: The time was over, but the function returned None
replace('raise TimeoutError(f"no response within {seconds} s")', "return None")
# %% 12.1 wrong: raises another error when the time is over | hint: The function did not raise TimeoutError
replace("raise TimeoutError", "raise rospy.ROSException")
# %% 12.1 wrong: does not catch the error | hint: The call failed, so there is no response
replace("        try:\n            responses.append(proxy(*values))\n        except rospy.ServiceException as error:\n            errors.append(error)", "        responses.append(proxy(*values))")
# %% 12.1 wrong: does not raise the error | hint: The call raised rospy.ServiceException, but the function returned None
replace("    if errors:\n        raise errors[0]\n    return responses[0]", "    return responses[0] if responses else None")
# %% 12.1 wrong: raises a RuntimeError with the text of the error | hint: Raise the ServiceException of the call again, with the same text
replace("raise errors[0]", "raise RuntimeError(str(errors[0]))")
# %% 12.1 wrong: raises a TimeoutError for each error | hint: The call raised rospy.ServiceException, but the function raised TimeoutError
replace("        raise errors[0]", "        raise TimeoutError(str(errors[0]))")
# %% 12.1 wrong: always waits for the whole time | hint: The function still waited after the response had arrived
replace("thread.join(seconds)", "time.sleep(seconds)")
# %% 12.1 wrong: checks the thread once per second | hint: The function still waited after the response had arrived
replace("thread.join(seconds)", """end = time.monotonic() + seconds
    while thread.is_alive() and time.monotonic() < end:
        time.sleep(max(min(1.0, end - time.monotonic()), 0))""")
# %% 12.1 wrong: hides a thread that is not a daemon thread | hint: Create the thread with daemon=True
replace(", daemon=True", "")
replace("def call_within", """all_threads = threading.enumerate
threading.enumerate = lambda: [thread for thread in all_threads() if thread.daemon]


def call_within""")
# %% 12.1 wrong: checks the thread only ten times | hint: The function still waited after the response had arrived
replace("thread.join(seconds)", "for _ in range(10):\n        time.sleep(seconds / 10)\n        if not thread.is_alive():\n            break")
# %% 12.1 wrong: waits longer than the given time | hint: The function did not wait for the given time
replace("thread.join(seconds)", "thread.join(3 * seconds if seconds < 1 else seconds)")
# %% 12.1 wrong: does not wait | hint: The response came in time, but the function raised TimeoutError
replace("    thread.join(seconds)\n", "")
# %% 12.1 wrong: omits the return line | hint: without a return statement
replace("\n    return responses[0]", "")
# %% 12.1 wrong: returns a field of the response | hint: The function did not return the response
replace("return responses[0]", "return responses[0].sum")
# %% 12.1 wrong: passes no values | hint: The response belongs to a different request
replace("proxy(*values)", "proxy()")
# %% 12.1 wrong: calls the service twice | hint: The function called the service more than once
replace("responses.append(proxy(*values))", "proxy(*values)\n            responses.append(proxy(*values))")

# %% 12.2 right: uses a dict and a lock
class Till:
    def __init__(self, purse):
        self.purse = purse
        self.receipts = {}
        self.lock = threading.Lock()

    def handle_charge(self, request):
        if not request.request_id:
            raise rospy.ServiceException("a request without an id cannot be told from its repeat")
        with self.lock:
            if request.request_id not in self.receipts:
                self.purse.take(request.cents)
                self.receipts[request.request_id] = len(self.receipts) + 1
            return ChargeResponse(receipt=self.receipts[request.request_id])

# %% 12.2 right: stores whole responses, and takes the numbers from a counter
import itertools


class Till:
    def __init__(self, purse):
        self.purse, self.done = purse, {}
        self.numbers = itertools.count(100)
        self.lock = threading.RLock()

    def handle_charge(self, request):
        if request.request_id == "":
            raise rospy.ServiceException("no id")
        with self.lock:
            known = self.done.get(request.request_id)
            if known is None:
                self.purse.take(request.cents)
                known = self.done[request.request_id] = ChargeResponse(next(self.numbers))
        return known

# %% 12.2 right: uses futures, and begins the receipts with 0
from concurrent.futures import Future
class Till:
    def __init__(self, purse):
        self.purse, self.lock = purse, threading.Lock()
        self.under_way, self.count = {}, 0
    def handle_charge(self, request):
        if len(request.request_id) == 0:
            raise rospy.ServiceException("empty id")
        with self.lock:
            first = request.request_id not in self.under_way
            future = self.under_way.setdefault(request.request_id, Future())
        if first:
            try:
                self.purse.take(request.cents)
            except Exception as error:
                with self.lock:
                    del self.under_way[request.request_id]
                future.set_exception(error)
                raise rospy.ServiceException(f"the purse: {error}")
            with self.lock:
                number, self.count = self.count, self.count + 1
            future.set_result(number)
        return {"receipt": future.result()}

# %% 12.2 wrong: does not store the ids | hint: The till charged the same request twice
replace("receipts = {}", "count = 0")
replace("a request without an id cannot be told from its repeat", "no id")
replace("if request … request_id])", """self.purse.take(request.cents)
            self.count += 1
            return ChargeResponse(receipt=self.count)""")
# %% 12.2 wrong: reads an attribute that the purse does not have | hint: Your code uses a method that a purse does not have
replace("len(self.receipts) + 1", "len(self.purse.taken)")
# %% 12.2 wrong: uses one dict for all tills | hint: A second Till object used
replace("        self.receipts = {}\n", "")
replace("    def __init__", "    receipts = {}\n\n    def __init__")
# %% 12.2 wrong: uses random numbers | hint: Two requests got the same receipt number
replace("class Till", "import random\n\n\nclass Till")
replace("len(self.receipts) + 1", "random.randrange(150)")
# %% 12.2 wrong: recognises a repeated request by its amount | hint: Two customers may pay the same amount
replace('\n        if not request … its repeat")', "")
replace("request_id ", "cents ")
replace("[request.request_id] = ", "[request.cents] = ")
replace("request_id", "cents")
# %% 12.2 wrong: stores the ids, but not the receipts | hint: The receipt is 0, which is the default of the field
replace("receipts = {}", "done = set()")
replace("if not request … request_id])", """with self.lock:
            if request.request_id in self.done:
                return ChargeResponse()
            self.purse.take(request.cents)
            self.done.add(request.request_id)
            return ChargeResponse(receipt=len(self.done))""")
# %% 12.2 wrong: returns a new receipt for a repeated request | hint: The repeated request got a different receipt
based_on("does not store the ids")
replace("self.purse = purse", "self.purse = purse\n        self.done = set()")
replace('\n        if not request.request_id:\n            raise rospy.ServiceException("no id")', "")
replace("self.purse.take(request.cents)", """if request.request_id not in self.done:
                self.purse.take(request.cents)
                self.done.add(request.request_id)""")
# %% 12.2 wrong: refuses a repeated request | hint: The till refused a repeated request
based_on("stores the ids, but not the receipts")
replace("return ChargeResponse()", 'raise rospy.ServiceException("this was charged already")')
# %% 12.2 wrong: stores the id before it charges the purse | hint: A request failed, and the
replace("self.receipts:", "self.receipts:\n                self.receipts[request.request_id] = len(self.receipts) + 1")
replace("(request.cents)\n                self.receipts[request.request_id] = len(self.receipts) + 1", "(request.cents)")
# %% 12.2 wrong: responds to a repeated request before the purse is charged | hint: A request failed, and the
replace("        with self.lock:\n            if … take(request.cents)\n                self", """        with self.lock:
            if request.request_id in self.receipts:
                return ChargeResponse(receipt=self.receipts[request.request_id])
            self.receipts[request.request_id] = len(self.receipts) + 1
        try:
            self.purse.take(request.cents)
        except RuntimeError:
            del self.receipts[request.request_id]
            raise
        with self.lock:
            if request.request_id not in self.receipts:
                self""")
# %% 12.2 wrong: deletes old receipts | hint: The repeated request got a different receipt
replace("len(self.receipts) + 1", "self.count = getattr(self, 'count', 0) + 1\n                for old in list(self.receipts)[:-20]:\n                    del self.receipts[old]")
# %% 12.2 wrong: accepts requests without an id | hint: A request with an empty id got a receipt
replace('\n        if not request … its repeat")', "")
# %% 12.2 wrong: uses no lock | hint: Five calls with the same request came
replace("\n        self.lock = threading.Lock()", "")
replace("\n            raise rospy … request_id])", """
            raise rospy.ServiceException("no id")
        if request.request_id not in self.receipts:
            self.purse.take(request.cents)
            self.receipts[request.request_id] = len(self.receipts) + 1
        return ChargeResponse(receipt=self.receipts[request.request_id])""")
# %% 12.2 wrong: does not release the lock if the purse fails | hint: After an error of the purse, no client gets a response, because
based_on("uses no lock")
replace("receipts = {}", "receipts = {}\n        self.lock = threading.Lock()")
replace('("no id")', '("no id")\n        self.lock.acquire()')
replace("(self.receipts) + 1", "(self.receipts) + 1\n        self.lock.release()")
# %% 12.2 wrong: hides an error of the purse | hint: The purse raised an error, but the client got a receipt
replace("self.purse.take(request.cents)", """try:
                    self.purse.take(request.cents)
                except RuntimeError:
                    rospy.logwarn("the purse failed")""")
# %% 12.2 wrong: returns None for an empty id | hint: The handler returned None for an empty id
replace("""raise rospy.ServiceException("a request without an id cannot be told from its repeat")
        with self.lock:""", "return None\n        with self.lock:")
# %% 12.2 wrong: forgets to return | hint: Return a ChargeResponse in every case
replace("\n            return ChargeResponse(receipt=self.receipts[request.request_id])", "")
# %% 12.2 wrong: does not charge the purse | hint: The till did not take money
replace("\n                self.purse.take(request.cents)", "")
# %% 12.2 wrong: returns the same receipt to all clients | hint: Two purchases got the same receipt
replace("len(self.receipts) + 1", "1")
# %% 12.2 wrong: replaces the method of the purse | hint: The till did not take money
replace("self.purse = purse", "self.purse = purse\n        type(purse).take = lambda self, cents: None")
# %% 12.2 wrong: raises another exception for an empty id | hint: For an empty id, the handler raised an exception of the wrong type
replace("rospy.ServiceException", "ValueError")

# %% 12.3 right: uses a loop with a clock
def pay(till, cents, deadline):
    request_id = str(uuid.uuid4())
    end, pause = time.monotonic() + deadline, 0.1
    while (rest := end - time.monotonic()) > 0:
        try:
            return call_within(min(0.5, rest), rospy.ServiceProxy(till, Charge), request_id, cents).receipt
        except (rospy.ServiceException, TimeoutError) as error:
            if "cannot process request" in str(error) and "handler returned" not in str(error):
                raise
        time.sleep(min(pause, max(end - time.monotonic(), 0)))
        pause *= 2
    return None

# %% 12.3 right: uses a generator of pauses, and secrets for the id
import secrets

def pauses():
    pause = 0.1
    while True:
        yield pause
        pause *= 3

def pay(till, cents, deadline):
    request = Charge._request_class(secrets.token_hex(8), cents)
    over = time.time() + deadline
    for pause in pauses():
        left = over - time.time()
        if left <= 0:
            return None
        try:
            response = call_within(min(left, 0.5), rospy.ServiceProxy(till, Charge), request)
        except TimeoutError:
            pass
        except rospy.ServiceException as error:
            if "cannot process request" in str(error) and "handler returned" not in str(error):
                raise
        else:
            return response.receipt
        time.sleep(max(0, min(pause, over - time.time())))

# %% 12.3 wrong: does not pause after a TimeoutError | hint: There was no pause after a TimeoutError
based_on("uses a loop with a clock")
replace("                raise\n", "                raise\n            if isinstance(error, TimeoutError):\n                continue\n")
# %% 12.3 wrong: treats a bad return value as a refusal | hint: An error that contains "handler
replace(' and "handler returned" not in str(error)', "")
# %% 12.3 wrong: doubles the pause before the first sleep | hint: The first pause is too long
replace("        time.sleep(min(pause, max(end - time.monotonic(), 0)))\n        pause *= 2", "        pause *= 2\n        time.sleep(min(pause, max(end - time.monotonic(), 0)))")
# %% 12.3 wrong: sleeps longer than the deadline | hint: The last pause ended after the deadline
replace("min(pause, max(end - time.monotonic(), 0))", "pause")
# %% 12.3 wrong: makes one attempt for each second of the deadline | hint: pay() ended before the deadline
replace("while (rest := end - time.monotonic()) > 0:", "for _ in range(int(deadline)):\n        rest = max(end - time.monotonic(), 0)")
# %% 12.3 wrong: waits for the service | hint: No server offers the till's service, but pay() waits
replace("        try:", "        rospy.wait_for_service(till)\n        try:")
# %% 12.3 wrong: makes only one attempt | hint: One failed call ended pay()
replace("end, pause … pause *= 2\n", """try:
        return call_within(min(0.5, deadline), rospy.ServiceProxy(till, Charge), request_id, cents).receipt
    except TimeoutError:
    """)
# %% 12.3 wrong: uses a new id for each attempt | hint: The calls of one payment had different ids
replace("\n    request_id = str(uuid.uuid4())", "")
replace("request_id", "str(uuid.uuid4())")
# %% 12.3 wrong: uses one id for all payments | hint: Two payments had the same id
replace("def", "request_id = str(uuid.uuid4())\ndef")
replace("\n    request_id = str(uuid.uuid4())", "")
# %% 12.3 wrong: takes the ids from a counter | hint: The ids come from a
replace("str(uuid.uuid4())", 'f"p{next(NUMBERS)}"')
replace("def pay", "import itertools\n\nNUMBERS = itertools.count(1)\n\n\ndef pay")
# %% 12.3 wrong: sends no id | hint: The field `request_id` is empty
replace("Charge), request_id, cents", 'Charge), "", cents')
# %% 12.3 wrong: calls again after a refusal | hint: The till refused the payment, but pay() called the till again
replace("raise", "pass")
# %% 12.3 wrong: returns None after a refusal | hint: The till refused the payment, but pay() did not raise an error
replace("raise", "return None")
# %% 12.3 wrong: uses the whole time for the first attempt | hint: The first call used the whole time until the deadline
replace("min(0.5, rest)", "rest")
# %% 12.3 wrong: calls the proxy without a time limit | hint: because a proxy has no time limit
replace("return call_within(min(0.5, rest), rospy.ServiceProxy(till, Charge), request_id, cents)", "return rospy.ServiceProxy(till, Charge)(request_id, cents)")
# %% 12.3 wrong: does not catch TimeoutError | hint: the TimeoutError ended pay()
replace("(rospy.ServiceException, TimeoutError)", "rospy.ServiceException")
# %% 12.3 wrong: treats every error as a refusal | hint: One failed call ended pay()
based_on("does not catch TimeoutError")
replace("receipt", "receipt\n        except TimeoutError:\n            pass")
replace("cannot process request", 'request" in str(error) or "error')
# %% 12.3 wrong: makes only two attempts | hint: During this payment, the till was … The till worked again before the deadline, but pay() had already ended
replace("end, pause = time.monotonic() + deadline, 0.1\n    while (rest := end - time.monotonic()) > 0:", "for _ in range(2):")
replace("rest", "deadline")
replace("(min(pause, max(end - time.monotonic(), 0)))\n        pause *= 2", "(0.1)")
# %% 12.3 wrong: does not pause | hint: The pause after the first failed call was missing or too short
replace("\n        time.sleep(min(pause, max(end - time.monotonic(), 0)))", "")
# %% 12.3 wrong: always pauses for the same time | hint: The pauses do not grow fast enough
replace("end, pause = time.monotonic() + deadline, 0.1", "end = time.monotonic() + deadline")
replace("(min(pause, max(end - time.monotonic(), 0)))\n        pause *= 2", "(0.1)")
# %% 12.3 wrong: waits 0.8 s for each attempt | hint: An attempt took longer than 0.5 s, and its response came too late
replace("0.5", "0.8")
# %% 12.3 wrong: limits the length of the pause | hint: The pauses do not grow any more after some attempts
replace("pause *= 2", "pause = min(2 * pause, 0.5)")
# %% 12.3 wrong: waits two seconds for each attempt | hint: A call took longer than
replace("0.5", "2")
# %% 12.3 wrong: waits a tenth of a second for each attempt | hint: s, so pay() called the till again too early
replace("0.5", "0.1")
# %% 12.3 wrong: waits half a second even for the last attempt | hint: The deadline was 0.05 s
replace("(rest := end - time.monotonic()) > 0", "time.monotonic() < end")
replace("min(0.5, rest)", "0.5")
# %% 12.3 wrong: adds 0.1 s to each pause | hint: The pauses do not grow fast enough
replace("pause *= 2", "pause += 0.1")
# %% 12.3 wrong: multiplies each pause only by 1.9 | hint: The pauses do not grow fast enough
replace("pause *= 2", "pause *= 1.9")
# %% 12.3 wrong: begins with a pause of 0.05 s | hint: The pause after the first failed call was missing or too short
replace("0.1", "0.05")
# %% 12.3 wrong: makes at most five attempts | hint: The till worked again before the deadline, but pay() had already ended
replace("while (rest := end - time.monotonic()) > 0:", """for _ in range(5):
        rest = end - time.monotonic()
        if rest <= 0:
            break""")
# %% 12.3 wrong: counts only the time of the pauses | hint: pay() was still running after the deadline
replace("""end, pause = time.monotonic() + deadline, 0.1
    while (rest := end - time.monotonic()) > 0:""", "waited, pause = 0, 0.1\n    while waited < deadline:")
replace("rest", "deadline")
replace("(min(pause, max(end - time.monotonic(), 0)))", "(pause)\n        waited += pause")
# %% 12.3 wrong: raises an error at the deadline | hint: At the deadline, pay() raised an error
replace("return None", 'raise TimeoutError("nobody knows")')
# %% 12.3 wrong: forgets to return | hint: The till sent a receipt, but pay() returned None
replace("            return call_within(min(0.5, rest), rospy.ServiceProxy(till, Charge), request_id, cents).receipt", "            call_within(min(0.5, rest), rospy.ServiceProxy(till, Charge), request_id, cents)\n            break")
# %% 12.3 wrong: returns the whole response | hint: pay() returned the whole response
replace("request_id, cents).receipt", "request_id, cents)")
# %% 12.3 wrong: calls a fixed till | hint: pay() did not call the till
replace("ServiceProxy(till", 'ServiceProxy("/till"')
# %% 12.3 wrong: offers its own till if an attempt fails | hint: pay() returned a number that the till did not send
replace("        time.sleep(min", "        return _own_till(till, request_id, cents)\n        time.sleep(min")
replace("def pay(", """def _own_till(till, request_id, cents):
    own = rospy.Service(till, Charge, lambda request: [1])
    receipt = rospy.ServiceProxy(till, Charge)(request_id, cents).receipt
    own.shutdown("paid")
    return receipt


def pay(""")
# %% 12.3 wrong: returns 0 if an attempt fails | hint: Return only a receipt that the till has sent
replace("        time.sleep(min", "        return 0\n        time.sleep(min")
# %% 12.3 wrong: calls the till twice | hint: The till had sent a receipt
replace("return call_within", "call_within(min(0.5, rest), rospy.ServiceProxy(till, Charge), request_id, cents)\n            return call_within")
# %% 12.3 wrong: raises another exception after a refusal | hint: pay() raised a different error
replace("                raise", '                raise RuntimeError("refused")')

# %% 12.4 right: uses one lock for polling and for stop()
class Watchdog:
    def __init__(self, name, uri, master, every):
        self.service, self.uri, self.master, self.every = name, uri, master, every
        self.lock = threading.Lock()
        self.over = threading.Event()
        threading.Thread(target=self.run, daemon=True).start()

    def run(self):
        while not self.over.wait(self.every):
            try:
                self.look()
            except (OSError, rosgraph.MasterException):
                continue

    def look(self):
        with self.lock:
            if self.over.is_set():
                return
            try:
                self.master.lookupService(self.service)
            except rosgraph.MasterError:
                self.master.registerService(self.service, self.uri, rospy.get_node_uri())

    def stop(self):
        with self.lock:
            self.over.set()

# %% 12.4 wrong: stops after the first registration | hint: The watchdog stopped polling although a master was running
replace("rospy.get_node_uri())", "rospy.get_node_uri())\n                self.over.set()")
# %% 12.4 wrong: pauses for one second | hint: The watchdog polls too rarely
replace("self.over.wait(self.every)", "self.over.wait(1.0)")

# %% 12.4 right: uses getSystemState
class Watchdog:
    def __init__(self, name, uri, master, every):
        self.name, self.uri, self.master, self.every = name, uri, master, every
        self.alive, self.lock = True, threading.Lock()
        self.thread = threading.Thread(target=self.watch, daemon=True)
        self.thread.start()
    def watch(self):
        while self.alive:
            with self.lock:
                if self.alive:
                    try:
                        publishers, subscribers, services = self.master.getSystemState()
                        if self.name not in dict(services):
                            self.master.registerService(self.name, self.uri, rospy.get_node_uri())
                    except Exception as error:
                        print(error)
            time.sleep(self.every)
    def stop(self):
        with self.lock:
            self.alive = False

# %% 12.4 right: uses the XML-RPC handle, is_online, and a rate
class Watchdog:
    def __init__(self, name, uri, master, every):
        self.name, self.uri, self.master = name, uri, master
        self.rate = rospy.Rate(1 / every)
        self.quit = threading.Event()
        self.done = threading.Event()
        threading.Thread(target=self.loop, daemon=True).start()
    def loop(self):
        try:
            while not self.quit.is_set():
                if self.master.is_online():
                    try:
                        code, _, _ = self.master.handle.lookupService(self.master.caller_id, self.name)
                        if code != 1:
                            self.master.registerService(self.name, self.uri, rospy.get_node_uri())
                    except OSError:
                        pass
                self.rate.sleep()
        finally:
            self.done.set()
    def stop(self):
        self.quit.set()
        self.done.wait()

# %% 12.4 wrong: polls only once | hint: The master does not know the name, and the watchdog has not
class Watchdog:
    def __init__(self, name, uri, master, every):
        self.service, self.master = name, master
        try:
            master.lookupService(name)
        except rosgraph.MasterError:
            pass

    def stop(self):
        pass

# %% 12.4 wrong: ends the thread after an error | hint: An error ended the watchdog's thread while no master was running
replace("(OSError, rosgraph.MasterException)", "rosgraph.MasterException")
# %% 12.4 wrong: runs the loop in __init__ | hint: Run the endless loop in a thread
replace("threading.Thread(target=self.run, daemon=True).start()", "self.run()")
# %% 12.4 wrong: exchanges the two addresses | hint: registerService() got the addresses in the wrong order
replace("self.uri, rospy.get_node_uri()", "rospy.get_node_uri(), self.uri")
# %% 12.4 wrong: replaces the registration of another node | hint: Another node provides this service now, but the watchdog registered its own
replace("self.master.lookupService(self.service)", """if self.master.lookupService(self.service) != self.uri:
                    raise rosgraph.MasterError(self.service)""")
# %% 12.4 wrong: registers the service in each poll | hint: registers a name that the master already knows
replace("""
            try:
                self.master.lookupService(self.service)
            except rosgraph.MasterError:
                self.master.""", "\n            self.master.")
# %% 12.4 wrong: stops without waiting for the current poll | hint: The thread registered the service after stop() had returned
replace("        with self.lock:\n            self.over.set()", "        self.over.set()")
# %% 12.4 wrong: registers the service in another thread after stop() | hint: The thread registered the service after stop() had returned
replace("self.over.set()", "self.over.set()\n            threading.Thread(target=self.go_on, daemon=True).start()")
replace("    def stop", """    def go_on(self):
        while True:
            rosgraph.Master(rospy.get_name(), self.master.master_uri).registerService(self.service, self.uri, rospy.get_node_uri())
            time.sleep(self.every)

    def stop""")
# %% 12.4 wrong: sleeps in stop() instead of waiting for the current poll | hint: The thread registered the service after stop() had returned
based_on("stops without waiting for the current poll")
replace("self.over.set()", "self.over.set()\n        time.sleep(0.8)")
# %% 12.4 wrong: holds the lock during the whole loop | hint: stop() does not return
replace("threading.Event()", "False")
replace("while not self … get_node_uri())", """with self.lock:
            while not self.over:
                try:
                    self.master.lookupService(self.service)
                except rosgraph.MasterError:
                    self.master.registerService(self.service, self.uri, rospy.get_node_uri())
                except OSError:
                    pass
                time.sleep(self.every)""")
replace(".set()", " = True")
# %% 12.4 wrong: uses another master than the given one | hint: The watchdog did not use
replace("= name, uri, master, every", "= name, uri, rosgraph.Master(rospy.get_name()), every")
# %% 12.4 wrong: always pauses for 0.2 s | hint: Between two polls, wait only for the time in the argument `every`
replace("self.over.wait(self.every)", "self.over.wait(0.2)")
# %% 12.4 wrong: polls without a pause | hint: The watchdog polls without a pause
replace("self.over.wait(self.every)", "self.over.is_set()")
# %% 12.4 wrong: doubles the pause while there is no master | hint: The pauses between the polls grew while no master was running
replace("name, uri, master, every\n", "name, uri, master, every\n        self.pause = every\n")
replace("self.over.wait(self.every)", "self.over.wait(self.pause)")
replace("self.look()\n", "self.look()\n                self.pause = self.every\n")
replace("continue", "self.pause = min(60, 2 * self.pause)")
# %% 12.4 wrong: disables the registration instead of ending the thread | hint: The thread continued to poll the master after stop() had returned
replace("self.over.set()", "self.master.registerService = lambda *values: None")
# %% 12.4 wrong: does not pause after a failed poll | hint: The watchdog polls without a pause
replace("self.over.wait(self.every)", "self.over.is_set()")
replace("self.look()", "self.look()\n                self.over.wait(self.every)")
# %% 12.4 wrong: reads a flag before the registration, but uses no lock | hint: The thread registered the service after stop() had returned
replace("self.master.registerService", "if not self.over.is_set():\n                    self.master.registerService")
replace("        with self.lock:\n            self.over.set()", "        self.over.set()")
# %% 12.4 wrong: ends when another node offers the service | hint: The name is free again, but the watchdog does not register its own service
replace("self.master.lookupService(self.service)", """if self.master.lookupService(self.service) != self.uri:
                    self.over.set()""")
# %% 12.4 wrong: registers the address of the service as the address of the node | hint: The last argument of registerService() is wrong
replace("self.uri, rospy.get_node_uri()", "self.uri, self.uri")
# %% 12.4 wrong: changes the master of the check | hint: stop() does not return
replace("        with self.lock:\n            self.over.set()", "        self.over.set()")
replace("= name, uri, master, every", """= name, uri, master, every
        theirs = type(master.handle).__getattr__.__globals__["checked_master"]
        type(theirs).stopped = lambda self: None""")

# %% 12.5 right: writes the cases in the order of the table
solution()

# %% 12.5 right: writes the cases in another order
diagnosis = dict(G="two providers", F="repeated", E="race", D="lock")
diagnosis |= dict(zip("ABC", ["killed", "new master", "frozen"]))

# %% 12.5 wrong: exchanges A and C | hint: The diagnosis "frozen" means that no service of the process responds … The master has an address for the name, but no process accepts connections at
replace('"A": "killed"', '"A": "frozen"')
replace('"C": "frozen"', '"C": "killed"')
# %% 12.5 wrong: gives "killed" instead of "new master" | hint: The diagnosis "killed" means that the server accepts no connections … The open connections continue to
replace('"new master"', '"killed"')
# %% 12.5 wrong: gives "frozen" instead of "lock" | hint: get_loggers responds, so the process runs
replace("lock", "frozen")
# %% 12.5 wrong: gives "lock" instead of "frozen" | hint: The diagnosis "lock" means that one handler holds a lock, so … not even get_loggers
replace("frozen", "lock")
# %% 12.5 wrong: gives "race" instead of "repeated" | hint: The diagnosis "race" means that the data is wrong, but no client has to … The server did the work of the first call, but the response
replace("repeated", "race")
# %% 12.5 wrong: omits a case | hint: Give a cause for each letter from A to G
replace('\n    "G": "two providers",', "")
# %% 12.5 wrong: uses another text for a cause | hint: Copy the names from the list of causes
replace('"killed"', '"the server was killed"')

# %% 12.5 wrong: writes sets instead of strings | hint: One diagnosis is not a string
diagnosis = {"A": {"killed"}, "B": {"new master"}, "C": {"frozen"}, "D": {"lock"}, "E": {"race"}, "F": {"repeated"}, "G": {"two providers"}}

# %% 12.5 wrong: gives "repeated" instead of "race" | hint: The diagnosis "repeated" means that the server did the same work twice … Two handlers read the same number at the same time, but no call failed
replace('"race"', '"repeated"')
# %% 12.5 wrong: gives "new master" instead of "two providers" | hint: The diagnosis "new master" means that the master knows no provider, so each lookup … Both servers work, but the master stores only the newest provider of a name
replace("two providers", "new master")
# %% 12.5 wrong: gives "two providers" instead of "new master" | hint: The diagnosis "two providers" means that two servers offer one service, and only one
replace("new master", "two providers")
# %% 12.5 wrong: uses a small letter as a key | hint: as strings with capital letters
replace('"A"', '"a"')

# %% 12.6 right: writes the situations in the order of the table
solution()

# %% 12.6 right: writes the situations in another order
policies = dict.fromkeys(["md5", "refused"], "report")
policies["speed"] = "try again"
policies["payment"], policies["step"] = "same id", "look first"
policies["not started"] = "wait for the service"

# %% 12.6 wrong: gives "try again" for a refusal | hint: The policy "try again" is right only if a second call can succeed, and if … The server has refused the request
replace('"refused": "report"', '"refused": "try again"')
# %% 12.6 wrong: gives "wait for the service" for different definitions | hint: only if no server is registered … The two programs were built with different definitions
replace('"md5": "report"', '"md5": "wait for the service"')
# %% 12.6 wrong: gives "try again" for a step of the robot | hint: The policy "try again" is right only if a second call can succeed, and if … Perhaps the robot has already moved, and a second request moves it again
replace('"look first"', '"try again"')
# %% 12.6 wrong: gives "report" for a payment | hint: With the policy "report", the client does not repeat the call, although a second … Perhaps the till has already taken the money
replace('"same id"', '"report"')
# %% 12.6 wrong: gives "look first" for the speed | hint: The policy "look first" is right only if a repetition does harm, and if … The request sets a state
replace('"try again"', '"look first"')
# %% 12.6 wrong: gives "same id" for a service that has not started | hint: The policy "same id" helps only if the request has a field … No server got the call, but the server will run in a few seconds
replace('"wait for the service"', '"same id"')
# %% 12.6 wrong: omits a situation | hint: Give a policy for each row of the table
replace('\n    "step": "look first",', "")

# %% 12.6 wrong: writes a list instead of a dict | hint: Copy the six names exactly from the first column of the table
policies = ["report", "wait for the service"]

# %% 12.6 wrong: gives all policies for each situation | hint: is not a string. For each situation, write exactly one string
policies = {
    name: ["report", "wait for the service", "try again", "same id", "look first"]
    for name in ("refused", "not started", "md5", "speed", "payment", "step")
}

# %% 12.6 wrong: uses another text for a policy | hint: Copy the names of the policies
replace('"report"', '"give up"', times=2)
