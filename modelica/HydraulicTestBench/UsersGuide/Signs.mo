within HydraulicTestBench.UsersGuide;
class Signs "Directions and signs"
  extends Icons.Information;
  annotation(DocumentationClass=true, Documentation(info="<html>
<ul>
<li>A flow variable (<code>q</code>, <code>tau</code>) is positive <b>into</b> the component.</li>
<li>u &gt; 0 joins P to chamber 1 and chamber 2 to T; chamber 1 fills, the piston moves to positive x<sub>p</sub>, the
angle grows.</li>
<li>Q1 is positive into chamber 1, Q2 positive out of chamber 2, QL positive from chamber 1 to chamber 2.</li>
<li>x<sub>p</sub> = 0 in the middle of the stroke; chamber 1 holds V<sub>0</sub> + A<sub>p</sub>x<sub>p</sub>, chamber 2
V<sub>0</sub> - A<sub>p</sub>x<sub>p</sub>.</li>
<li>A force in the slot <code>pistonForce</code> is positive towards positive x<sub>p</sub>: friction is
-F tanh(v/v<sub>t</sub>), a spring -kx.</li>
<li>The supply delivers Q = Q1 for u &ge; 0 and Q = -Q2 for u &lt; 0; it is negative where a chamber stands above supply
pressure.</li>
<li>A pump at positive speed and angle gives out at port A and takes in at B; a motor takes in at A, and its torque
on the
shaft is positive where A has the higher pressure.</li>
<li>On the test bench positive speed is that which the supply motor drives; the load motor sees the shaft from the other
side. T<sub>L</sub> and p<sub>L</sub> are positive where they hold against positive speed.</li>
<li>Heights point upwards: a drum that turns positively hoists.</li>
</ul>
<p><b>Source:</b> thesis Eq. 3.1 to 3.9, Fig. 3.2. The third row of Eq. 3.15 there reads
x<sub>4</sub>/m<sub>eff</sub>; by
its own definition of the states it has to be dx<sub>3</sub>/dt = x<sub>4</sub>.</p>
</html>"));
end Signs;
