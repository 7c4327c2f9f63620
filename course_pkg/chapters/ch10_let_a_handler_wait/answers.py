"""Example answers of chapter 10; tests/checking/answers/example_answers.py explains the format."""

# %% 10.1 right: starts one thread for each call
def call_at_once(name, count):
    messages = []

    def call():
        proxy = rospy.ServiceProxy(name, Trigger)
        messages.append(proxy().message)

    threads = [threading.Thread(target=call) for _ in range(count)]
    for thread in threads:
        thread.start()
    for thread in threads:
        thread.join()
    return messages

# %% 10.1 right: uses a pool of threads and one proxy
from concurrent.futures import ThreadPoolExecutor


def call_at_once(name, count):
    proxy = rospy.ServiceProxy(name, Trigger)
    with ThreadPoolExecutor(count) as pool:
        futures = [pool.submit(proxy) for _ in range(count)]
        return [future.result().message for future in futures]

# %% 10.1 right: uses a subclass of Thread
class Caller(threading.Thread):
    def __init__(self, name):
        super().__init__(daemon=True)
        self.proxy = rospy.ServiceProxy(name, Trigger)
        self.message = ""

    def run(self):
        self.message = self.proxy.call().message


def call_at_once(name, count):
    callers = [Caller(name) for number in range(count)]
    for caller in callers:
        caller.start()
    for caller in callers:
        caller.join()
    return tuple(caller.message for caller in callers)

# %% 10.1 wrong: makes one call after the other | hint: The second call began after the first call had returned
replace("messages = … return messages", "proxy = rospy.ServiceProxy(name, Trigger)\n    return [proxy().message for _ in range(count)]")
# %% 10.1 wrong: joins each thread directly after its start | hint: The second call began after the first call had returned
replace("thread.start()\n    for thread in threads:", "thread.start()")
# %% 10.1 wrong: calls the function instead of passing it to the thread | hint: The second call began after the first call had returned
replace("target=call)", "target=call())")
# %% 10.1 wrong: does not join the threads | hint: call join() of every thread without
replace("\n    for thread in threads:\n        thread.join()", "")
# %% 10.1 wrong: sleeps for a second instead of joining | hint: call join() of every thread without
replace("for thread in threads:\n        thread.join()", "time.sleep(1)")
# %% 10.1 wrong: uses one persistent proxy for all threads | hint: Two threads call the same persistent proxy
replace("    def call():\n        proxy = rospy.ServiceProxy(name, Trigger)\n", "    proxy = rospy.ServiceProxy(name, Trigger, persistent=True)\n\n    def call():\n")
# %% 10.1 wrong: hides the calls of a persistent proxy | hint: Two threads call the same persistent proxy
replace("def call_at_once", "call_of_proxy = rospy.ServiceProxy.call\n\n\ndef call_at_once")
replace("rospy.ServiceProxy(name, Trigger)", "rospy.ServiceProxy(name, Trigger, persistent=True)")
replace("proxy().message", "call_of_proxy(proxy).message")
# %% 10.1 wrong: returns whole responses | hint: The list contains whole responses
replace("proxy().message", "proxy()")
# %% 10.1 wrong: starts one thread too few | hint: The service was called too few times
replace("range(count)", "range(count - 1)")
# %% 10.1 wrong: makes an additional call after the threads | hint: The service was called too many times
replace("    for thread in threads:\n        thread.join()", "    for thread in threads:\n        thread.join()\n    call()")
# %% 10.1 wrong: starts no thread | hint: Call start() of each thread first
replace("\n    for thread in threads:\n        thread.start()", "")
# %% 10.1 wrong: calls another service | hint: The service was not called
replace("ServiceProxy(name", 'ServiceProxy("/count_up"')
replace("messages.append(proxy().message)", "try:\n            messages.append(proxy().message)\n        except rospy.ServiceException:\n            messages.append(name)")
# %% 10.1 wrong: passes args that is not a tuple | hint: The service was not called
replace("def call():", "def call(name):")
replace("target=call)", "target=call, args=name)")
# %% 10.1 wrong: runs rosservice in other processes | hint: Another program called the service
import re
import subprocess


def call_at_once(name, count):
    command = ["rosservice", "call", name]
    helpers = [subprocess.Popen(command, stdout=subprocess.PIPE, text=True) for _ in range(count)]
    texts = [helper.communicate()[0] for helper in helpers]
    return [re.search(r"message: [\"']?(.*?)[\"']?$", text, re.M)[1] for text in texts]

# %% 10.1 wrong: returns the results of join() | hint: The list contains None
replace("messages.append(proxy().message)", "proxy()")
replace("return messages", "return [thread.join() for thread in threads]")
# %% 10.1 wrong: stores the messages in a set | hint: Two clients got the same message
replace("messages = []", "messages = set()")
replace("messages.append", "messages.add")
replace("return messages", "return list(messages)")
# %% 10.1 wrong: joins each thread with a time limit | hint: call join() of every thread without
replace("thread.join()", "thread.join(0.2)")
# %% 10.1 wrong: joins each thread with a time limit of 1 s | hint: call join() of every thread without
replace("thread.join()", "thread.join(timeout=1)")
# %% 10.1 wrong: joins a thread with a time limit of 2 s | hint: call join() of every thread without
replace("thread.join()", "thread.join(timeout=2)")
# %% 10.1 wrong: creates the list as a default argument | hint: The list also contains messages of an earlier call
replace("count):\n    messages = []\n", "count, messages=[]):\n")
# %% 10.1 wrong: ignores the messages of responses with success=False | hint: The message of a response with success=False is missing
replace("messages.append(proxy().message)", "response = proxy()\n        if response.success:\n            messages.append(response.message)")
# %% 10.1 wrong: returns a dict of the messages | hint: The list does not contain the right messages
replace("return messages", "return {message: True for message in messages}")
# %% 10.1 wrong: omits the return line | hint: without a return statement
replace("\n    return messages", "")
# %% 10.1 wrong: uses a pool with one thread too few | hint: Some calls began only after other calls had returned
based_on("uses a pool of threads and one proxy")
replace("(count) as", "(count - 1 or 1) as")
# %% 10.1 wrong: waits until the list of threads is empty | hint: All calls have returned, but your function has not returned
replace("for thread in threads:\n        thread.join()", "while threads:\n        time.sleep(0.01)")

# %% 10.2 right: uses wait_for, and then looks again
def handle_detect(watch, request):
    with watch.changed:
        watch.changed.wait_for(lambda: watch.next(request.after), timeout=request.patience)
        customer = watch.next(request.after)
    if customer is None:
        return False, 0, rospy.Time()
    return True, customer.number, customer.arrived

# %% 10.2 right: uses the return value of wait_for
replace("(watch, request):", "(watch, request):\n    def who():\n        return watch.next(request.after)\n")
replace("watch.changed.wait_for … customer.arrived", """customer = watch.changed.wait_for(who, request.patience)
    if customer:
        return DetectCustomerResponse(detected=True, number=customer.number, arrived=customer.arrived)
    return DetectCustomerResponse(detected=False)""")

# %% 10.2 right: uses a loop with wait
def handle_detect(watch, request):
    end = time.monotonic() + request.patience
    with watch.changed:
        customer = watch.next(request.after)
        while customer is None and time.monotonic() < end:
            watch.changed.wait(end - time.monotonic())
            customer = watch.next(request.after)
    if customer is None:
        return {"detected": False}
    return {"detected": True, "number": customer.number, "arrived": customer.arrived}

# %% 10.2 right: checks ten times per second
def handle_detect(watch, request):
    end = time.monotonic() + request.patience
    while True:
        customer = watch.next(request.after)
        if customer:
            return True, customer.number, customer.arrived
        if time.monotonic() >= end:
            return False, 0, rospy.Time()
        time.sleep(0.1)

# %% 10.2 wrong: waits without a limit | hint: The handler waits longer than request.patience
replace("(request.after), timeout=request.patience", "(request.after)")
replace("\n    if customer is None:\n        return False, 0, rospy.Time()", "")
# %% 10.2 wrong: starts the time limit again after each change | hint: The time limit started again from the beginning when the customers changed
replace("watch.changed.wait_for(lambda: watch.next(request.after), timeout=request.patience)", """while watch.next(request.after) is None:
            if not watch.changed.wait(request.patience):
                break""")
# %% 10.2 wrong: remembers a customer who has left | hint: No customer is there. Set the field `detected` to False
replace("def handle_detect", "seen = {}\n\n\ndef handle_detect")
replace("        customer = watch.next(request.after)\n", "        customer = seen.get(request.after) or watch.next(request.after)\n    if customer:\n        seen[request.after] = customer\n")
# %% 10.2 wrong: checks twice per second | hint: so it notices a customer late
based_on("checks ten times per second")
replace("0.1", "0.5")
# %% 10.2 wrong: reads the customer again without the lock | hint: The handler called watch.next() twice, but the customer left before the second call
replace("\n        customer = watch.next(request.after)\n", "\n    customer = watch.next(request.after)\n")
# %% 10.2 wrong: reads the customer's fields without the lock | hint: The handler called watch.next() twice, but the customer left before the second call
replace("watch.changed.wait_for … customer.arrived", """there = watch.changed.wait_for(lambda: watch.next(request.after), request.patience)
    if not there:
        return False, 0, rospy.Time()
    return True, watch.next(request.after).number, watch.next(request.after).arrived""")
# %% 10.2 wrong: checks once, and does not wait | hint: The handler returned too early
replace("\n    with watch … customer = watch.next(request.after)", "\n    customer = watch.next(request.after)")
# %% 10.2 wrong: sleeps before the check | hint: A customer was there before the call
replace("with watch.changed:\n        watch.changed.wait_for(lambda: watch.next(request.after), timeout=", "time.sleep(")
replace("        customer", "    customer")
# %% 10.2 wrong: waits for a change without a check | hint: A customer was there before the call
replace("wait_for(lambda: watch.next(request.after), timeout=request.patience)", "wait(request.patience)")
# %% 10.2 wrong: returns after any change | hint: The handler returned before the time was over
replace("\n        watch.changed.wait_for(lambda: watch.next(request.after), timeout=request.patience)", """
        if watch.next(request.after) is None:
            watch.changed.wait(request.patience)""")
# %% 10.2 wrong: uses a loop without a pause | hint: Your loop has no pause, so it checks for a customer thousands of times
replace("\n    with watch … customer = watch.next(request.after)", """
    end = time.monotonic() + request.patience
    while time.monotonic() < end and watch.next(request.after) is None:
        pass
    customer = watch.next(request.after)""")
# %% 10.2 wrong: waits for 0 s once, and then checks rarely | hint: so it notices a customer late
based_on("checks ten times per second")
replace("    while True:", "    with watch.changed:\n        watch.changed.wait(0)\n    while True:")
replace("time.sleep(0.1)", "time.sleep(min(1.2, end - time.monotonic()))")
# %% 10.2 wrong: sleeps while it holds the condition | hint: The handler did not notice a new customer, because it holds the lock of
replace("(watch, request):", "(watch, request):\n    end = time.monotonic() + request.patience")
replace("watch.changed.wait_for(lambda: watch.next(request.after), timeout=request.patience)", """while watch.next(request.after) is None and time.monotonic() < end:
            time.sleep(0.05)""")
# %% 10.2 wrong: ignores the field `after` | hint: The handler returned a customer who is already known to the client
replace("watch.next(request.after)", "watch.next()", times=2)
# %% 10.2 wrong: uses a fixed timeout | hint: The handler waits longer than request.patience
replace("timeout=request.patience", "timeout=5")
# %% 10.2 wrong: treats the field `patience` as milliseconds | hint: The handler returned too early
replace("timeout=request.patience", "timeout=request.patience / 1000")
# %% 10.2 wrong: passes a value to wait_for instead of a function | hint: The argument of `wait_for` has to be a function, because `wait_for` calls this function
replace("watch.changed.wait_for(lambda: ", "customer = watch.changed.wait_for(")
replace("\n        customer = watch.next(request.after)", "")
# %% 10.2 wrong: reads the fields of None if there is no customer | hint: watch.next() returns None if no customer is there, and None has no
replace("\n        watch.changed … customer.arrived", """
        customer = watch.changed.wait_for(lambda: watch.next(request.after), timeout=request.patience)
    return customer is not None, customer.number, customer.arrived""")
# %% 10.2 wrong: returns None if there is no customer | hint: Return a response even if no customer came
based_on("reads the fields of None if there is no customer")
replace("return customer is not None", "if customer:\n        return True")
# %% 10.2 wrong: waits without holding the condition | hint: The methods `wait` and `wait_for` need the lock
replace("with watch … customer = watch.next(request.after)", "customer = watch.changed.wait_for(lambda: watch.next(request.after), timeout=request.patience)")
# %% 10.2 wrong: omits the number | hint: The field `number` has its default value, 0
replace("watch.changed.wait_for … customer.arrived", """customer = watch.changed.wait_for(lambda: watch.next(request.after), timeout=request.patience)
    return DetectCustomerResponse(detected=customer is not None)""")
# %% 10.2 wrong: omits the time of arrival | hint: The response does not contain the time
based_on("reads the fields of None if there is no customer")
replace("number, customer.arrived", "number if customer else 0, rospy.Time()")
# %% 10.2 wrong: rounds the field `patience` down to whole seconds | hint: and do not round this number
replace("request.patience", "int(request.patience)")
# %% 10.2 wrong: misses a customer who comes between the check and the wait | hint: so the handler missed the notification
def handle_detect(watch, request):
    end = time.monotonic() + request.patience
    customer = watch.next(request.after)
    while customer is None and time.monotonic() < end:
        with watch.changed:
            watch.changed.wait(max(end - time.monotonic(), 0))
        customer = watch.next(request.after)
    if customer is None:
        return DetectCustomerResponse(detected=False)
    return DetectCustomerResponse(detected=True, number=customer.number, arrived=customer.arrived)

# %% 10.2 wrong: lets only one caller wait at a time | hint: One client had to wait for another client
replace("def", "door = threading.Lock()\ndef")
replace("with watch.changed:", "with door, watch.changed:")
replace("watch.changed.wait_for", "customer = watch.changed.wait_for")
replace("\n        customer = watch.next(request.after)", "")
# %% 10.2 wrong: returns the time of the response | hint: Two calls for the same customer returned different times
replace("watch.changed.wait_for", "customer = watch.changed.wait_for")
replace("\n        customer = watch.next(request.after)", "")
replace("customer.arrived", "rospy.Time.now()")
# %% 10.2 wrong: returns the time of the response after a wait | hint: Two calls for the same customer returned different times
replace("    with watch.changed:", "    with watch.changed:\n        waited = not watch.next(request.after)")
replace("customer.arrived", "rospy.Time.now() if waited else customer.arrived")
# %% 10.2 wrong: returns a time although there is no customer | hint: The field `arrived` is wrong
replace("watch.changed.wait_for", "customer = watch.changed.wait_for")
replace("\n        customer = watch.next(request.after)", "")
replace("rospy.Time()", "rospy.Time.now()")
# %% 10.2 wrong: waits twice as long as requested | hint: The handler waits longer than request.patience
replace("timeout=request.patience", "timeout=2 * request.patience")
# %% 10.2 wrong: returns a number although there is no customer | hint: No customer is there
replace("watch.changed.wait_for", "customer = watch.changed.wait_for")
replace("\n        customer = watch.next(request.after)", "")
replace("0", "request.after")
# %% 10.2 wrong: raises an error if there is no customer | hint: The handler raised an error although it is normal that no customer comes
replace("watch.changed.wait_for", "customer = watch.changed.wait_for")
replace("\n        customer = watch.next(request.after)", "")
replace("return False, 0, rospy.Time()", 'raise rospy.ServiceException("nobody came")')
# %% 10.2 wrong: does not check if the field `patience` is 0 | hint: If request.patience is 0, do not wait, but still call watch.next() once
based_on("checks ten times per second")
replace("True:", "time.monotonic() < end:")
replace("if time.monotonic … sleep(0.1)", "time.sleep(0.1)\n    return False, 0, rospy.Time()")
# %% 10.2 wrong: checks, sleeps, and checks again | hint: the handler continued to wait
based_on("checks once, and does not wait")
replace("None:", "None:\n        time.sleep(request.patience)\n        customer = watch.next(request.after)\n    if customer is None:")
# %% 10.2 wrong: omits the field `detected` | hint: The number is right, but `detected` is False
based_on("uses the return value of wait_for")
replace("detected=True, number", "number")
# %% 10.2 wrong: returns the number of customers | hint: The response contains a wrong number
replace("customer.number", "watch.count")

# %% 10.3 right: uses wait_for
class Basket:
    def __init__(self, limit):
        self.limit = limit
        self.items = 0
        self.changed = threading.Condition()

    def handle_put(self, request):
        with self.changed:
            self.items += 1
            self.changed.notify_all()
            return TriggerResponse(success=True, message=str(self.items))

    def handle_take(self, request):
        with self.changed:
            if not self.changed.wait_for(lambda: self.items > 0, timeout=self.limit):
                return TriggerResponse(success=False, message="empty")
            self.items -= 1
            return TriggerResponse(success=True, message=str(self.items))

# %% 10.3 right: uses a loop with a deadline, and notify
class Basket:
    def __init__(self, limit):
        self.limit, self.items = limit, 0
        self.changed = threading.Condition()

    def handle_put(self, request):
        with self.changed:
            self.items += 1
            self.changed.notify()
            return True, str(self.items)

    def handle_take(self, request):
        end = time.monotonic() + self.limit
        with self.changed:
            while self.items == 0:
                left = end - time.monotonic()
                if left <= 0:
                    return False, "empty"
                self.changed.wait(left)
            self.items -= 1
            return True, str(self.items)

# %% 10.3 right: creates its services in __init__
replace("changed = threading.Condition()", """lock = threading.RLock()
        self.there = threading.Condition(self.lock)
        self.put_service = rospy.Service("/put", Trigger, self.handle_put)
        self.take_service = rospy.Service("/take", Trigger, self.handle_take)""")
replace("def handle_put(self, request):\n        with self.changed:", "def handle_put(self, request):\n        with self.lock:")
replace("self.changed.notify_all()\n            return TriggerResponse(success=True, message=str(self.items))", """self.there.notify_all()
            count = self.items
        return TriggerResponse(True, f"{count}")""")
replace("with self.changed … self.items))", """with self.there:
            found = self.there.wait_for(self.is_filled, self.limit)
            if found:
                self.items -= 1
            return {"success": found, "message": str(self.items) if found else "empty"}

    def is_filled(self):
        return self.items > 0""")
# %% 10.3 wrong: does not call notify | hint: An item came, but the waiting call did not return
replace("\n            self.changed.notify_all()", "")
# %% 10.3 wrong: stores the items in a list of the class | hint: Two baskets share their items
replace("    def __init__", "    items = []\n\n    def __init__")
replace("        self.items = 0\n", "")
replace("self.items += 1", "self.items.append(1)")
replace("str(self.items)", "str(len(self.items))", times=2)
replace("self.items > 0", "self.items")
replace("self.items -= 1", "self.items.pop()")
# %% 10.3 wrong: does not check again after a wake-up | hint: The handler of /take returned an item although the basket was empty
replace("if not self.changed.wait_for(lambda: self.items > 0, timeout=self.limit)", "if self.items == 0 and not self.changed.wait(self.limit)")
# %% 10.3 wrong: waits without a limit | hint: The handler of /take waits longer than the time limit
replace(", timeout=self.limit", "")
# %% 10.3 wrong: does not wait for an item | hint: The handler of /take returned before its time limit was over
replace("not self.changed.wait_for(lambda: self.items > 0, timeout=self.limit)", "self.items == 0")
# %% 10.3 wrong: gives up after the first wake-up | hint: The handler of /take returned before its time limit was over
replace("not self.changed.wait_for(lambda: self.items > 0, timeout=self.limit):", """self.items == 0:
                self.changed.wait(self.limit)
            if self.items == 0:""")
# %% 10.3 wrong: gives up after the first wake-up, and hides the condition in a list | hint: The handler of /take returned before its time limit was over
based_on("gives up after the first wake-up")
replace("        self.changed = ", "        self.tools = [None]\n        self.tools[0] = ")
replace("self.changed", "self.tools[0]", times=4)
# %% 10.3 wrong: waits before the check | hint: An item was in the basket before the call
replace("if not self.changed.wait_for(lambda: self.items > 0, timeout=self.limit):", "self.changed.wait(self.limit)\n            if self.items == 0:")
# %% 10.3 wrong: waits for the whole limit after each wake-up | hint: The handler of /take waits longer than the time limit
based_on("uses a loop with a deadline, and notify")
replace("notify", "notify_all")
replace("\n        end = time.monotonic() + self.limit", "")
replace("left = end … wait(left)", 'if not self.changed.wait(self.limit):\n                    return False, "empty"')
# %% 10.3 wrong: waits for the whole limit after each wake-up, and uses notify | hint: The handler of /take waits longer than the time limit
based_on("waits for the whole limit after each wake-up")
replace("self.changed.notify_all()", "self.changed.notify()")
# %% 10.3 wrong: sleeps while it holds the lock | hint: /put did not respond while a call of /take was waiting
based_on("uses a loop with a deadline, and notify")
replace("self.changed.wait(left)", "time.sleep(0.05)")
# %% 10.3 wrong: waits without the lock | hint: The methods `wait` and `notify` need the lock of the condition
based_on("uses a loop with a deadline, and notify")
replace("with self.changed:\n            while", "if True:\n            while")
# %% 10.3 wrong: returns a number as the message | hint: The field `message` has to be a string
replace("message=str(self.items)", "message=self.items", times=2)
# %% 10.3 wrong: raises an error if the basket is empty | hint: An empty basket is not an error
replace('return TriggerResponse(success=False, message="empty")', 'raise rospy.ServiceException("empty")')
# %% 10.3 wrong: returns None after the time limit | hint: not a response. Return a response in every case
replace('return TriggerResponse(success=False, message="empty")', "return None")
# %% 10.3 wrong: returns another message for an empty basket | hint: No item came, but the response is wrong
replace('"empty"', '"nothing there"')
# %% 10.3 wrong: accepts only ten items | hint: The basket did not accept an item
replace("            self.items += 1", """            if self.items >= 10:
                return TriggerResponse(success=False, message="full")
            self.items += 1""")
# %% 10.3 wrong: omits success | hint: The message is right, but the field `success` is wrong
replace("success=True, ", "", times=2)
# %% 10.3 wrong: returns the number before the change | hint: the number of items in the basket after the call
based_on("uses a loop with a deadline, and notify")
replace("True, str(self.items)\n\n", "True, str(self.items - 1)\n\n")

# %% 10.4 right: uses a with block
class Stock:
    def __init__(self, shelf):
        self.shelf = shelf
        self.lock = threading.Lock()

    def handle_take(self, request):
        with self.lock:
            count = self.shelf.read()
            if count == 0:
                return TriggerResponse(success=False, message="sold out")
            self.shelf.write(count - 1)
        return TriggerResponse(success=True, message=str(count - 1))

# %% 10.4 right: uses acquire and release, and one lock for all objects
class Stock:
    everybody = threading.RLock()

    def __init__(self, shelf):
        self.shelf = shelf

    def handle_take(self, request):
        Stock.everybody.acquire()
        try:
            if self.shelf.read() <= 0:
                return False, "sold out"
            left = self.shelf.read() - 1
            self.shelf.write(left)
            return True, str(left)
        finally:
            Stock.everybody.release()

# %% 10.4 wrong: uses no lock | hint: Two handlers read the same number
replace("        self.lock = … count - 1)", """
    def handle_take(self, request):
        count = self.shelf.read()
        if count == 0:
            return TriggerResponse(success=False, message="sold out")
        self.shelf.write(count - 1)""")
# %% 10.4 wrong: changes rospy instead of using a lock | hint: The handlers never ran at the same time
based_on("uses no lock")
replace("class Stock", """from rospy.impl.tcpros_service import ServiceImpl

LOCK, HANDLE = threading.Lock(), ServiceImpl._handle_request


def one_by_one(self, transport, request):
    with LOCK:
        return HANDLE(self, transport, request)


ServiceImpl._handle_request = one_by_one


class Stock""")
# %% 10.4 wrong: reads the shelf again after it has released the lock | hint: Two clients got the same number of things
replace("        return TriggerResponse(success=True, message=str(count - 1))", "        return TriggerResponse(success=True, message=str(self.shelf.read()))")
# %% 10.4 wrong: reads the shelf only once | hint: New things were put on the shelf
replace("self.shelf = shelf", "self.shelf, self.count = shelf, shelf.read()")
replace("            count = self.shelf.read()\n", "            count = self.count\n")
replace("self.shelf.write(count - 1)", "self.count = count - 1\n            self.shelf.write(count - 1)")
# %% 10.4 wrong: creates a lock for each call | hint: Two handlers read the same number, so too many things were sold
replace("\n        self.lock = threading.Lock()", "")
replace("self.lock", "threading.Lock()")
replace("(count - 1)\n        ", "(count - 1)\n            ")
# %% 10.4 wrong: locks only the writing | hint: Two handlers read the same number, so too many things were sold
based_on("uses no lock")
replace("\n\n", "\n\n        self.lock = threading.Lock()\n\n")
replace("self.shelf.write(count - 1)", "with self.lock:\n            self.shelf.write(count - 1)")
# %% 10.4 wrong: uses a flag instead of a lock | hint: such as a threading.Lock, while you read, decide and write
class Stock:
    def __init__(self, shelf):
        self.shelf = shelf
        self.busy = False

    def handle_take(self, request):
        while self.busy:
            time.sleep(0.001)
        self.busy = True
        try:
            count = self.shelf.read()
            if count == 0:
                return TriggerResponse(success=False, message="sold out")
            self.shelf.write(count - 1)
            return TriggerResponse(success=True, message=str(count - 1))
        finally:
            self.busy = False


stock = Stock(Shelf(10))
stock_service = rospy.Service("/take_from_stock", Trigger, stock.handle_take)

# %% 10.4 wrong: does not release the lock if the shelf is empty | hint: A client waits forever, because a thread does not release the lock
replace("with self. … count - 1)", """self.lock.acquire()
        count = self.shelf.read()
        if count == 0:
            return TriggerResponse(success=False, message="sold out")
        self.shelf.write(count - 1)
        self.lock.release()""")
# %% 10.4 wrong: acquires the lock again while it holds the lock | hint: A client waits forever, because a thread does not release the lock
replace("Lock()\n", "Lock()\n\n    def left(self):\n        with self.lock:\n            return self.shelf.read()\n")
replace("= self.shelf.read()", "= self.left()")
# %% 10.4 wrong: refuses a caller while the lock is taken | hint: The shelf was not empty, but a
replace("with self.lock:", """if not self.lock.acquire(blocking=False):
            return TriggerResponse(success=False, message="busy")
        try:""")
replace("(count - 1)\n        ", "(count - 1)\n            ")
replace("1))", "1))\n        finally:\n            self.lock.release()")
# %% 10.4 wrong: does not check whether the shelf is empty | hint: The shelf was empty, but `success` is True
replace("count = self … count - 1))", """count = self.shelf.read() - 1
            self.shelf.write(count)
        return TriggerResponse(success=True, message=str(count))""")
# %% 10.4 wrong: returns the number before the sale | hint: The message is the number before the sale
replace("str(count - 1)", "str(count)")
# %% 10.4 wrong: does not write to the shelf | hint: The number on the shelf is wrong
replace("shelf = shelf", "count = shelf.read()")
replace("count = self.shelf.read()\n            if count == 0:", "if self.count == 0:")
replace("shelf.write(count - 1)", "count -= 1")
replace("return TriggerResponse(success=True, message=str(count - 1))", "    return TriggerResponse(success=True, message=str(self.count))")
# %% 10.4 wrong: raises an error if the shelf is empty | hint: "Sold out" is a normal response, not an error
replace('return TriggerResponse(success=False, message="', 'raise rospy.ServiceException("')
# %% 10.4 wrong: returns a number as the message | hint: The field `message` has to be a string
replace("str(count - 1)", "count - 1")
# %% 10.4 wrong: reads with the lock, and writes without the lock | hint: Two handlers read the same number, so too many things were sold
replace("\n            if count = … count - 1)", """
        if count == 0:
            return TriggerResponse(success=False, message="sold out")
        self.shelf.write(count - 1)""")
# %% 10.4 wrong: does not create the lock | hint: self.lock does not exist
replace("\n        self.lock = threading.Lock()", "")
# %% 10.4 wrong: changes an attribute of the shelf | hint: Your code uses a method that a shelf does not have
replace("self.shelf.read()", "self.shelf.count")
replace("self.shelf.write(count - 1)", "self.shelf.count -= 1")
# %% 10.4 wrong: omits success | hint: The shelf was not empty, but `success`
replace("success=True, message=str", "message=str")
# %% 10.4 wrong: omits the message | hint: Set the message to the number of things that are left, as a string
replace(", message=str(count - 1)", "")
# %% 10.4 wrong: returns another message for an empty shelf | hint: Return the number of things that are left, such as "7", or the text
replace('"sold out"', '"nothing left"')
# %% 10.4 wrong: replaces the methods of the shelf | hint: The number on the shelf is wrong
replace("        self.lock = threading.Lock()", """        self.lock = threading.Lock()
        shelf.things = shelf.read()
        type(shelf).read = lambda self: self.things
        type(shelf).write = lambda self, count: setattr(self, "things", count)""")

# %% 10.5 right: reserves, pays, and puts back after a failure
class Shop:
    def __init__(self, shelf, cents, till):
        self.shelf = shelf
        self.cents = cents
        self.till = till
        self.lock = threading.Lock()

    def handle_left(self, request):
        with self.lock:
            return TriggerResponse(success=True, message=str(self.shelf.read()))

    def handle_buy(self, request):
        with self.lock:
            count = self.shelf.read()
            if count == 0:
                return TriggerResponse(success=False, message="sold out")
            self.shelf.write(count - 1)
        try:
            receipt = rospy.ServiceProxy(self.till, Charge)(str(uuid.uuid4()), self.cents).receipt
        except rospy.ServiceException as error:
            with self.lock:
                self.shelf.write(self.shelf.read() + 1)
            return TriggerResponse(success=False, message=f"not paid: {error}")
        return TriggerResponse(success=True, message=str(receipt))

# %% 10.5 right: uses a separate method for changes
class Shop:
    def __init__(self, shelf, cents, till):
        self.shelf, self.cents = shelf, cents
        self.pay = rospy.ServiceProxy(till, Charge)
        self.lock = threading.Lock()
        self.number = 0

    def change(self, by):
        with self.lock:
            count = self.shelf.read() + by
            if count < 0:
                return None
            self.shelf.write(count)
            self.number += 1
            return self.number

    def handle_left(self, request):
        return True, str(self.shelf.read())

    def handle_buy(self, request):
        number = self.change(-1)
        if number is None:
            return False, "sold out"
        try:
            answer = self.pay(request_id=f"{id(self)}-{number}", cents=self.cents)
        except rospy.ServiceException as error:
            self.change(+1)
            return False, str(error)
        return True, str(answer.receipt)

# %% 10.5 wrong: holds the lock during the call | hint: Your handler holds the lock while it calls the till, so /left cannot
replace('self.shelf.write(count - … : {error}")', """try:
                receipt = rospy.ServiceProxy(self.till, Charge)(str(uuid.uuid4()), self.cents).receipt
            except rospy.ServiceException as error:
                return TriggerResponse(success=False, message=f"not paid: {error}")
            self.shelf.write(count - 1)""")
# %% 10.5 wrong: holds the lock during the call, and /left waits only briefly | hint: The till received only a
replace("        with self.lock:\n            return Trigger", "        held = self.lock.acquire(timeout=0.2)\n        number = self.shelf.read()\n        if held:\n            self.lock.release()\n        return Trigger")
replace('message=str(self.shelf.read())', 'message=str(number)')
replace('self.shelf.write(count - … : {error}")', """self.shelf.write(count - 1)
            try:
                receipt = rospy.ServiceProxy(self.till, Charge)(str(uuid.uuid4()), self.cents).receipt
            except rospy.ServiceException as error:
                self.shelf.write(count)
                return TriggerResponse(success=False, message=f"not paid: {error}")""")
# %% 10.5 wrong: holds a semaphore with two permits during the call | hint: The till received only a
replace("    def handle_buy(self, request):", """    permits = threading.BoundedSemaphore(2)

    def handle_buy(self, request):
        with self.permits:
            return self.buy()

    def buy(self):""")
# %% 10.5 wrong: takes the thing after the payment | hint: the thing is still on the shelf
replace("count = self.shelf.read()\n            if count == 0:", "if self.shelf.read() == 0:")
replace("\n            self.shelf.write(count - 1)", "")
replace("\n            with self.lock:\n                self.shelf.write(self.shelf.read() + 1)", "")
replace('(success=False, message=f"not paid: {error}")', """(success=False, message=f"not paid: {error}")
        with self.lock:
            self.shelf.write(self.shelf.read() - 1)""")
# %% 10.5 wrong: counts the buyers only in /left | hint: The number on the shelf is different from the number that /left returns
based_on("takes the thing after the payment")
replace("self.lock = threading.Lock()", "self.lock = threading.Lock()\n        self.paying = 0")
replace("message=str(self.shelf.read())", "message=str(self.shelf.read() - self.paying)")
replace("if self.shelf.read() == 0:", "if self.shelf.read() == self.paying:")
replace("        try:", "            self.paying += 1\n        try:")
replace("as error:", "as error:\n            with self.lock:\n                self.paying -= 1")
replace("self.shelf.write(self.shelf.read() - 1)", "self.shelf.write(self.shelf.read() - 1)\n            self.paying -= 1")
# %% 10.5 wrong: puts nothing back after a failed payment | hint: the thing is not on the shelf
replace("\n            with self.lock:\n                self.shelf.write(self.shelf.read() + 1)", "")
# %% 10.5 wrong: catches no exception | hint: The call of the till failed, and the exception ended your handler
replace('try: … : {error}")', "receipt = rospy.ServiceProxy(self.till, Charge)(str(uuid.uuid4()), self.cents).receipt")
# %% 10.5 wrong: puts back the number that it read before | hint: Another thread changed the shelf
replace("with self.lock:\n                self.shelf.write(self.shelf.read() + 1)", "time.sleep(0.2)\n            self.shelf.write(count)")
# %% 10.5 wrong: waits for the till's service | hint: No server offers the till's service, but the handler waits
replace("try:", "rospy.wait_for_service(self.till)\n        try:")
# %% 10.5 wrong: sells if there is no till | hint: No server offers the till's service, so the client did not pay
replace("as error:\n", 'as error:\n            if "unavailable" in str(error):\n                return TriggerResponse(success=True, message="pay later")\n')
# %% 10.5 wrong: puts nothing back if there is no till | hint: so the thing is not sold
replace("as error:\n", 'as error:\n            if "unavailable" in str(error):\n                return TriggerResponse(success=False, message="no till")\n')
# %% 10.5 wrong: uses one id for all payments | hint: Two purchases have the same request_id
replace("threading.Lock()", "threading.Lock()\n        self.request_id = str(uuid.uuid4())")
replace("str(uuid.uuid4()),", "self.request_id,")
# %% 10.5 wrong: takes the ids from a counter | hint: The ids come from a
replace("str(uuid.uuid4())", "str(next(NUMBERS))")
replace("class Shop", "import itertools\n\nNUMBERS = itertools.count(1)\n\n\nclass Shop")
# %% 10.5 wrong: takes the ids from a counter, with a fixed text | hint: Two Shop objects created the same request_id
replace("self.till = till", "self.till = till\n        self.number = 0")
replace("self.shelf.write(count - 1)", 'self.shelf.write(count - 1)\n            self.number += 1\n            request_id = f"shop1-{self.number}"')
replace("str(uuid.uuid4())", "request_id")
# %% 10.5 wrong: calls a missing till three times | hint: The call of the till failed, and your handler called the till
replace("            receipt = rospy.ServiceProxy(self.till, Charge)(str(uuid.uuid4()), self.cents).receipt", "            receipt = self.pay(str(uuid.uuid4()))")
replace("    def handle_buy", """    def pay(self, request_id):
        for attempt in (1, 2, 3):
            try:
                return rospy.ServiceProxy(self.till, Charge)(request_id, self.cents).receipt
            except rospy.ServiceException as error:
                if "unavailable" not in str(error) or attempt == 3:
                    raise
                time.sleep(0.1)

    def handle_buy""")
# %% 10.5 wrong: sends no id | hint: The field `request_id` is empty
replace('try: … : {error}")', "receipt = rospy.ServiceProxy(self.till, Charge)(cents=self.cents).receipt")
# %% 10.5 wrong: returns another message for an empty shelf | hint: The shelf is empty, but the handler did not report this
replace('"sold out"', '"nothing left"')
# %% 10.5 wrong: omits the reason in the message | hint: If the call of the till fails, return the text of the error, str(error),
replace('False, message=f"not paid: {error}"', "False")
# %% 10.5 wrong: calls the till again after a failure | hint: The call of the till failed, and your handler called the till
replace("self.shelf = shelf … threading.Lock()\n", """self.shelf, self.cents, self.till = shelf, cents, till
        self.lock = threading.Lock()""")
replace("(success=True, message=str(self.shelf.read()))\n", "(success=True, message=str(self.shelf.read()))")
replace("try: … (receipt))", """request_id = str(uuid.uuid4())
        for _ in range(3):
            try:
                receipt = rospy.ServiceProxy(self.till, Charge)(request_id, self.cents).receipt
                return TriggerResponse(success=True, message=str(receipt))
            except rospy.ServiceException as error:
                why = str(error)
        with self.lock:
            self.shelf.write(self.shelf.read() + 1)
        return TriggerResponse(success=False, message=why)""")
# %% 10.5 wrong: uses the number on the shelf as the request_id | hint: Two purchases have the same request_id
replace("str(uuid.uuid4())", 'f"purchase {count}"')
# %% 10.5 wrong: raises an error if the shelf is empty | hint: "Sold out" is a normal response of /buy, not an error
replace('return TriggerResponse(success=False, message="', 'raise rospy.ServiceException("')
# %% 10.5 wrong: does not release the lock | hint: A client waits forever, because a lock was not released
replace("with self.lock:\n                self.shelf.write(self.shelf.read() + 1)", "self.lock.acquire()\n            self.shelf.write(self.shelf.read() + 1)")
# %% 10.5 wrong: sends another price | hint: The till was called with a wrong amount, or more than once
replace("self.cents).receipt", "100 * self.cents).receipt")
# %% 10.5 wrong: does not call the till | hint: The till was not called
replace("rospy.ServiceProxy(self.till, Charge)(str(uuid.uuid4()), self.cents).receipt", "uuid.uuid4()")
# %% 10.5 wrong: returns a sentence in /left instead of the number | hint: The message of /left is wrong
replace("message=str(self.shelf.read())", 'message=f"{self.shelf.read()} are left"')
# %% 10.5 wrong: omits success | hint: The till has taken the money, but `success` is False
replace("success=True, message=str(receipt)", "message=str(receipt)")
# %% 10.5 wrong: returns the number on the shelf instead of the receipt | hint: The message of /buy is wrong
replace("str(receipt)", "str(count - 1)")
# %% 10.5 wrong: returns success=True although the payment failed | hint: The till did not take the money, but `success` is True
replace('success=False, message=f"not paid', 'success=True, message=f"not paid')
# %% 10.5 wrong: replaces the methods of the shelf | hint: The number on the shelf is different from the number that /left returns
replace("        self.shelf = shelf", """        self.shelf = shelf
        shelf.things = shelf.read()
        type(shelf).read = lambda self: self.things
        type(shelf).write = lambda self, count: setattr(self, "things", count)""")

# %% 10.6 right: sorts the shelves by their numbers
def move(source, target):
    first, second = sorted((source, target), key=lambda shelf: shelf.number)
    with first.lock, second.lock:
        if source.count == 0:
            return False
        source.count -= 1
        target.count += 1
        return True

# %% 10.6 right: uses acquire and release
def move(source, target):
    if source.number < target.number:
        locks = [source.lock, target.lock]
    else:
        locks = [target.lock, source.lock]
    for lock in locks:
        lock.acquire()
    moved = source.count > 0
    if moved:
        source.count = source.count - 1
        target.count = target.count + 1
    for lock in locks:
        lock.release()
    return moved

# %% 10.6 right: tries the second lock, and releases the first lock if this fails
import random


def move(source, target):
    while True:
        with source.lock:
            if target.lock.acquire(blocking=False):
                try:
                    if source.count <= 0:
                        return False
                    source.count -= 1
                    target.count += 1
                    return True
                finally:
                    target.lock.release()
        time.sleep(0.03 * random.random())

# %% 10.6 wrong: locks the source first | hint: Two threads acquired the two locks in opposite orders, so each of them waits
replace("    first, second = sorted((source, target), key=lambda shelf: shelf.number)\n", "")
replace("with first.lock, second.lock", "with source.lock, target.lock")

# %% 10.6 wrong: changes threading instead of the order of the locks | hint: The threads of the check ran one after the other
based_on("locks the source first")
replace("def move", """class Inline(threading.Thread):
    def start(self):
        self.run()

    def join(self, timeout=None):
        pass


threading.Thread = Inline


def move""")
# %% 10.6 wrong: locks the target first | hint: Two threads acquired the two locks in opposite orders, so each of them waits
def move(source, target):
    with target.lock:
        with source.lock:
            if source.count == 0:
                return False
            source.count -= 1
            target.count += 1
            return True

# %% 10.6 wrong: holds only one lock at a time | hint: The function changed a count while it did not hold both locks, so another
replace("first, second = sorted((source, target), key=lambda shelf: shelf.number)\n    with first.lock, second.lock:", "with source.lock:")
replace("\n        target.count += 1\n        return True", "\n    with target.lock:\n        target.count += 1\n    return True")
# %% 10.6 wrong: uses one additional lock for all moves | hint: The function changed a count while it did not hold both locks, so another
replace("def move", "whole = threading.Lock()\n\n\ndef move")
replace("with first.lock, second.lock", "with whole")
# %% 10.6 wrong: does not check the number on the source shelf | hint: The count of an empty shelf became negative
replace("if source.count == 0:\n            return False\n        ", "if source.count == -1:\n            return False\n        ")
replace("        return True", "        return source.count >= 0")
# %% 10.6 wrong: returns True for an empty shelf | hint: The returned value is wrong
replace("return False", "return True")
# %% 10.6 wrong: omits the return value | hint: The function returned None. Return True
replace("\n        return True", "")
replace("return False", "return")
# %% 10.6 wrong: acquires the same lock twice | hint: a lock that its own thread already holds
replace("first.lock, second.lock", "first.lock, first.lock")
# %% 10.6 wrong: releases the locks only after a move | hint: The function returned, but a lock is still held
based_on("uses acquire and release")
replace("        target.count = target.count + 1\n    for lock in locks:\n        lock.release()", "        target.count = target.count + 1\n        for lock in locks:\n            lock.release()")
# %% 10.6 wrong: releases a lock twice | hint: The function released a lock that it did not hold
replace("        return True", "        first.lock.release()\n        return True")
# %% 10.6 wrong: sorts the shelves without a key | hint: Python cannot compare two shelves
replace(", key=lambda shelf: shelf.number", "")
# %% 10.6 wrong: gives up if a lock is taken | hint: although the shelf was not empty
based_on("tries the second lock, and releases the first lock if this fails")
replace("        time.sleep(0.03 * random.random())", "        return False")
# %% 10.6 wrong: gives up after half a second | hint: although the shelf was not empty
def move(source, target):
    with source.lock:
        if not target.lock.acquire(timeout=0.5):
            return False
        try:
            if source.count == 0:
                return False
            source.count -= 1
            target.count += 1
            return True
        finally:
            target.lock.release()

# %% 10.6 wrong: tries again while it holds the first lock | hint: release the first lock before each new attempt
based_on("locks the target first")
replace("with target.lock:\n        with source.lock:", """with source.lock:
        while not target.lock.acquire(blocking=False):
            time.sleep(0.01)
        try:""")
replace("return True", "return True\n        finally:\n            target.lock.release()")
# %% 10.6 wrong: does not add to the target shelf | hint: The total number of things changed
replace("\n        target.count += 1", "")
# %% 10.6 wrong: moves two things | hint: The counts after the call are wrong
replace("source.count -= 1", "source.count, target.count = source.count - 2, target.count + 1")
# %% 10.6 wrong: checks the number before it has the locks | hint: The function read a count before it held both locks, so another thread can
replace("    first, second", "    if source.count == 0:\n        return False\n    first, second")
# %% 10.6 wrong: orders the locks by the numbers on the shelves | hint: The function read a count before it held both locks, so another thread can
replace("shelf.number", "shelf.count")
# %% 10.6 wrong: always moves from the first lock's shelf to the second lock's shelf | hint: The counts after the call are wrong
replace("source.count", "first.count", times=2)
replace("target.count", "second.count")
# %% 10.6 wrong: always moves from the second lock's shelf to the first lock's shelf | hint: The source was not empty, but the function returned False
replace("source.count", "second.count", times=2)
replace("target.count", "first.count")
# %% 10.6 wrong: replaces the locks of the shelves | hint: The function changed a count while it did not hold both locks, so another
replace("    first, second", """    own = property(lambda self: vars(self).setdefault("own_lock", threading.Lock()))
    type(source).lock = type(target).lock = own
    first, second""")

# %% 10.7 right: writes the cases in the order of the table
solution()

# %% 10.7 right: writes the cases in another order
causes = dict(F="no loop", E="no notify", D="race")
causes.update(zip("ABC", ["lock across a call", "lock order", "no limit"]))

# %% 10.7 wrong: exchanges A and B | hint: The cause "lock order" means that two threads … There is a circle of
replace('"A": "lock across a call"', '"A": "lock order"')
replace('"B": "lock order"', '"B": "lock across a call"')
# %% 10.7 wrong: gives "lock across a call" instead of "lock order" | hint: The cause "lock across a call" means … Each of the two threads holds the lock of one shelf and
replace('"lock order"', '"lock across a call"')
# %% 10.7 wrong: exchanges C and E | hint: The cause "no notify" means that a thread sleeps although an item is there … The clients have ended, but the number of waiting threads still grows
replace('"C": "no limit"', '"C": "no notify"')
replace('"E": "no notify"', '"E": "no limit"')
# %% 10.7 wrong: gives "no limit" instead of "no notify" | hint: The cause "no limit" means that a wait never ends, even after the client … The item came after two seconds, but the handler returned only when
replace('"no notify"', '"no limit"')
# %% 10.7 wrong: exchanges D and F | hint: The cause "no loop" means that a thread continues after it has woken up, … Only the returned numbers are wrong
replace('"D": "race"', '"D": "no loop"')
replace('"F": "no loop"', '"F": "race"')
# %% 10.7 wrong: gives "race" instead of "no loop" | hint: In a race, no thread waits … Only one item came, but several threads woke up, and each of them took
replace('"no loop"', '"race"')
# %% 10.7 wrong: omits a case | hint: The answer for a case is missing
replace('\n    "F": "no loop",', "")
# %% 10.7 wrong: uses a small letter as a key | hint: as strings with capital letters
replace('"A"', '"a"')
# %% 10.7 wrong: uses another text for a cause | hint: Copy the names from the list of causes
replace('"race"', '"data race"')
