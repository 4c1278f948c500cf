within HydraulicTestBench;
package UsersGuide "Guide to the library"
  extends Icons.Information;
  annotation(DocumentationClass=true, Documentation(info="<html>
<p>The library describes the swash plate control of a hydraulic pump so that a simulation can be set beside
measurements,
and so that physics the model lacks can be added at one place, by one class.</p>
<ul>
<li><code>PumpModel</code>: what to compile, inputs, outputs, parameters</li>
<li><code>PumpBlock</code>: the pump with shaft and ports, in a circuit</li>
<li><code>Conventions</code>, <code>Signs</code>, <code>Connectors</code>: how to read and join the parts</li>
<li><code>Slots</code>, <code>AddAnEffect</code>: where physics may be missing and how to add it</li>
<li><code>References</code>: where everything comes from</li>
</ul>
<p><b>Source:</b> thesis, see <code>References</code>.</p>
</html>"));
end UsersGuide;
